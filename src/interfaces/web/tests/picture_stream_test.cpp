// The picture stream of WebServer, and responses that come later.
#include <memory>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/web/web_server.hpp"

namespace passo {
namespace {

class PictureHandler final : public WebHandler {
 public:
  WebService find(const WebRequest& head) override {
    return {.is_pictures = head.path == "/pictures", .answer = [this](const WebRequest&) {
              ++answered;
              return WebAnswer{.later = [this](WebAnswer& answer) {
                ++looks;
                answer = {.type = "text/plain", .body = "now"};
                return is_known;
              }};
            }};
  }
  WebAnswer refusal(unsigned status) override { return {.status = status, .type = "text/plain", .body = "refused"}; }
  std::string hear(std::string_view, std::uint64_t) override { return {}; }

  int answered = 0;
  int looks = 0;
  bool is_known = false;
};

class Viewer {
 public:
  Viewer(unsigned port, const std::string& path, const std::string& more = "")
      : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const std::string request = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
    EXPECT_EQ(send(socket_, request.data(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
    fcntl(socket_, F_SETFL, O_NONBLOCK);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  ~Viewer() { close(socket_); }
  void look() {
    char bytes[65'536];
    for (ssize_t got = 1; got > 0;) {
      got = recv(socket_, bytes, sizeof bytes, 0);
      if (got > 0) heard.append(bytes, static_cast<std::size_t>(got));
      if (got == 0) is_closed = true;
    }
  }
  bool has(const std::string& text) const { return heard.find(text) != std::string::npos; }

  std::string heard;
  bool is_closed = false;

 private:
  int socket_;
};

class PictureStream : public testing::Test {
 protected:
  template <class Condition>
  bool turn_until(Condition condition, std::initializer_list<Viewer*> viewers = {}) {
    for (int i = 0; i < 20'000 && !condition(); ++i) {
      for (Viewer* const one : viewers) one->look();
      server->poll();
      if (i > 100) usleep(100);
    }
    return condition();
  }
  void show(const std::string& jpeg) const { server->show(std::make_shared<const std::string>(jpeg)); }
  std::string refusal_of(const std::string& path, const std::string& more) {
    Viewer viewer(server->port(), path, more);
    EXPECT_TRUE(turn_until([&] { return viewer.is_closed; }, {&viewer}));
    return viewer.heard.substr(0, viewer.heard.find("\r\n"));
  }

  PictureHandler handler;
  std::unique_ptr<WebServer> server =
      std::move(*WebServer::listen("127.0.0.1", 0, {.names = {"localhost"}}, handler, {.viewers = 2}));
};

TEST_F(PictureStream, sends_each_picture_with_its_length_and_the_delimiter_at_once) {
  Viewer viewer(server->port(), "/pictures");
  ASSERT_TRUE(turn_until([&] { return viewer.has("--picture\r\n"); }, {&viewer}));
  EXPECT_TRUE(
      viewer.heard.starts_with("HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n"));
  EXPECT_TRUE(viewer.has("Cross-Origin-Resource-Policy: same-origin\r\n"));
  viewer.heard.clear();
  for (const char* const picture : {"one", "two!"}) {
    show(picture);
    const std::string part =
        "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(std::string(picture).size()) + "\r\n\r\n" +
        picture + "\r\n--picture\r\n";
    ASSERT_TRUE(turn_until([&] { return viewer.heard.size() >= part.size(); }, {&viewer}));
    EXPECT_EQ(viewer.heard, part);
    viewer.heard.clear();
  }
  EXPECT_EQ(server->viewers(), 1U);
  EXPECT_EQ(handler.answered, 0);
}

TEST_F(PictureStream, shows_a_newcomer_the_present_picture_but_none_from_before_everyone_left) {
  show("old");
  auto first = std::make_unique<Viewer>(server->port(), "/pictures");
  ASSERT_TRUE(turn_until([&] { return first->has("--picture"); }, {first.get()}));
  EXPECT_FALSE(first->has("old"));
  show("new");
  Viewer second(server->port(), "/pictures");
  EXPECT_TRUE(turn_until([&] { return second.has("new") && first->has("new"); }, {first.get(), &second}));
  first.reset();
  EXPECT_TRUE(turn_until([&] { return server->viewers() == 1; })) << "noticed although no picture is sent";
}

TEST_F(PictureStream, lets_a_slow_viewer_skip_pictures_and_keeps_no_more_than_one) {
  Viewer slow(server->port(), "/pictures");
  Viewer quick(server->port(), "/pictures");
  ASSERT_TRUE(turn_until([&] { return server->viewers() == 2; }));
  const std::string rest(300'000, 'x');
  auto newest = std::make_shared<const std::string>();
  std::weak_ptr<const std::string> early;
  for (int i = 0; i < 40; ++i) {
    newest = std::make_shared<const std::string>("picture " + std::to_string(i) + " " + rest);
    if (i == 20) early = newest;
    server->show(newest);
    for (int turns = 0; turns < 20; ++turns) {
      server->poll();
      quick.look();
    }
  }
  EXPECT_TRUE(early.expired()) << "a picture that nobody is being sent is freed";
  ASSERT_TRUE(turn_until([&] { return slow.has("picture 39 ") && quick.has("picture 39 "); }, {&slow, &quick}));
  EXPECT_LT(slow.heard.size(), 40U * rest.size() / 4);
  EXPECT_FALSE(slow.has("picture 20 "));
}

TEST_F(PictureStream, has_room_for_few_viewers_and_only_for_pages_of_its_own) {
  EXPECT_EQ(refusal_of("/pictures", "Origin: http://evil.example\r\n"), "HTTP/1.1 403 Forbidden");
  Viewer one(server->port(), "/pictures");
  Viewer two(server->port(), "/pictures");
  ASSERT_TRUE(turn_until([&] { return server->viewers() == 2; }, {&one, &two}));
  EXPECT_EQ(refusal_of("/pictures", ""), "HTTP/1.1 503 Service Unavailable");
  EXPECT_EQ(server->connections(), 2U);
}

TEST_F(PictureStream, ends_with_the_server) {
  Viewer viewer(server->port(), "/pictures");
  Viewer waits(server->port(), "/later");
  ASSERT_TRUE(turn_until([&] { return server->viewers() == 1 && handler.looks > 0; }, {&viewer, &waits}));
  show(std::string(3'000'000, 'x'));
  server->poll();
  server.reset();
  viewer.look();
  EXPECT_TRUE(viewer.is_closed);
}

TEST_F(PictureStream, sends_a_response_that_is_known_later) {
  Viewer viewer(server->port(), "/later", "Connection: close\r\n");
  ASSERT_TRUE(turn_until([&] { return handler.looks >= 3; }, {&viewer}));
  EXPECT_EQ(viewer.heard, "");
  std::vector<pollfd> all;
  server->add_to(all);
  EXPECT_EQ(all.size(), 1U) << "only newcomers wake the loop";
  handler.is_known = true;
  ASSERT_TRUE(turn_until([&] { return viewer.is_closed; }, {&viewer}));
  EXPECT_TRUE(viewer.heard.ends_with("\r\n\r\nnow"));
  EXPECT_EQ(handler.answered, 1);
}

TEST_F(PictureStream, forgets_a_response_whose_client_has_gone) {
  auto viewer = std::make_unique<Viewer>(server->port(), "/later");
  ASSERT_TRUE(turn_until([&] { return handler.looks >= 1; }));
  viewer.reset();
  handler.is_known = true;
  EXPECT_TRUE(turn_until([&] { return server->connections() == 0; }));
}

}  // namespace
}  // namespace passo
