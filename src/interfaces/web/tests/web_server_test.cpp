// WebServer, spoken to byte by byte over a real socket by clients of every kind: good, slow, greedy and hostile.
#include "passo/web/web_server.hpp"

#include <cerrno>
#include <memory>
#include <random>
#include <vector>

#include "kit/seed.hpp"
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo {
namespace {

class Echo final : public WebHandler {
 public:
  WebService find(const WebRequest& head) override {
    ++found;
    return {.longest_body = head.path == "/upload" ? std::size_t{1'000'000} : std::size_t{100},
            .is_stream = head.path == "/stream",
            .answer = [this](const WebRequest& request) { return answer(request); }};
  }
  WebAnswer answer(const WebRequest& request) {
    last = request;
    ++answered;
    if (request.path == "/large") return {.body = std::string(8'000'000, 'x')};
    return {.status = 200, .type = "text/plain", .body = request.method + " " + request.path + " " + request.body};
  }
  WebAnswer refusal(unsigned status) override { return {.status = status, .type = "text/plain", .body = "refused"}; }
  void gone(std::uint64_t client) override { left.push_back(client); }
  std::string hear(std::string_view message, std::uint64_t client) override {
    ++heard;
    speaker = client;
    return "heard " + std::string(message);
  }

  WebRequest last;
  int found = 0;
  int answered = 0;
  int heard = 0;
  std::uint64_t speaker = 0;
  std::vector<std::uint64_t> left;
};

// A client, which waits for nothing either.
class Caller {
 public:
  explicit Caller(unsigned port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    fcntl(socket_, F_SETFL, O_NONBLOCK);
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;
  ~Caller() { close(socket_); }

  void send(std::string_view bytes) { unsent_ += bytes; }
  void look(bool reads = true) {
    if (!unsent_.empty()) {
      const ssize_t sent = ::send(socket_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
      if (sent > 0) unsent_.erase(0, static_cast<std::size_t>(sent));
      if (sent < 0 && errno != EAGAIN) unsent_.clear();
    }
    char bytes[65'536];
    while (reads) {
      const ssize_t got = recv(socket_, bytes, sizeof bytes, 0);
      if (got > 0) heard.append(bytes, static_cast<std::size_t>(got));
      if (got == 0 || (got < 0 && errno != EAGAIN)) closed = true;
      if (got <= 0) return;
    }
  }
  bool has_sent() const { return unsent_.empty(); }

  std::string heard;
  bool closed = false;

 private:
  int socket_;
  std::string unsent_;
};

class WebServerTest : public testing::Test {
 protected:
  explicit WebServerTest(const WebLimits& limits = {}) {
    server = std::move(*WebServer::listen("127.0.0.1", 0, {.names = {"localhost"}, .token = ""}, echo, limits));
  }
  template <class Condition>
  bool turn_until(Condition condition, std::initializer_list<Caller*> callers) {
    for (int i = 0; i < 200'000 && !condition(); ++i) {
      for (Caller* const one : callers) one->look();
      server->poll();
      if (i > 1000) usleep(100);
    }
    return condition();
  }
  // The whole answer to one request, after which the connection is over.
  std::string answer_to(const std::string& bytes) {
    Caller caller(server->port());
    caller.send(bytes);
    EXPECT_TRUE(turn_until([&] { return caller.closed; }, {&caller})) << bytes.substr(0, 80);
    return caller.heard;
  }
  static std::string get(const std::string& path, const std::string& more = "Connection: close\r\n") {
    return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
  }
  static std::string status_of(const std::string& answer) { return answer.substr(0, answer.find("\r\n")); }
  std::unique_ptr<Caller> watcher(const std::string& query = "") {
    auto caller = std::make_unique<Caller>(server->port());
    caller->send(get("/stream" + query,
                     "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"));
    EXPECT_TRUE(turn_until([&] { return caller->heard.find("\r\n\r\n") != std::string::npos; }, {caller.get()}));
    EXPECT_NE(caller->heard.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos) << "RFC 6455, 1.3";
    caller->heard.clear();
    return caller;
  }
  // A text message of a client, which has to be masked; here with zeros.
  static std::string frame(std::string_view text) {
    return std::string("\x81") + static_cast<char>(0x80 | text.size()) + std::string(4, '\0') + std::string(text);
  }

  Echo echo;
  std::unique_ptr<WebServer> server;
};

TEST_F(WebServerTest, answers_one_request_after_the_other) {
  Caller caller(server->port());
  caller.send(get("/a?b=1", "X-Passo-Key: k\r\n") + get("/c"));
  ASSERT_TRUE(turn_until([&] { return caller.closed; }, {&caller}));
  EXPECT_NE(caller.heard.find("GET /a "), std::string::npos);
  EXPECT_NE(caller.heard.find("GET /c "), std::string::npos);
  EXPECT_EQ(server->requests(), 2U);
  EXPECT_EQ(echo.found, 2) << "once for each";
  EXPECT_EQ(server->connections(), 0U);
  answer_to(
      "POST /p?q HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: 3\r\nX-Passo-Key: k\r\n\r\nabc");
  EXPECT_EQ(echo.last.body, "abc");
  EXPECT_EQ(echo.last.query, "q");
  EXPECT_EQ(echo.last.key, "k");
}

TEST_F(WebServerTest, refuses_what_is_not_for_it_before_the_body_is_read) {
  const std::string body = "POST /p HTTP/1.1\r\nContent-Length: 90000000\r\n";
  EXPECT_EQ(status_of(answer_to(body + "Host: localhost\r\n\r\n")), "HTTP/1.1 413 Payload Too Large");
  EXPECT_EQ(status_of(answer_to(body + "Host: evil.example\r\n\r\n")), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(status_of(answer_to("GET / HTTP/1.1\r\n\r\n")), "HTTP/1.1 400 Bad Request");
  EXPECT_EQ(status_of(answer_to(get("/", "Origin: http://evil.example\r\n"))), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(status_of(answer_to(get("/", "X: " + std::string(20'000, 'x') + "\r\n"))),
            "HTTP/1.1 431 Request Header Fields Too Large");
  const std::string chunked = "POST /p HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
  EXPECT_EQ(status_of(answer_to(chunked + "fff\r\n" + std::string(4095, 'x') + "\r\n0\r\n\r\n")),
            "HTTP/1.1 413 Payload Too Large");
  EXPECT_EQ(echo.answered, 0);
}

// A browser opens a WebSocket to any server for any page, and tells whose page it is.
TEST_F(WebServerTest, opens_no_stream_for_a_page_of_another_server) {
  const std::string upgrade =
      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  for (const char* const of : {"Origin: http://evil.example\r\n", "Origin: null\r\n"}) {
    EXPECT_EQ(status_of(answer_to(get("/stream", of + upgrade) + frame("hi"))), "HTTP/1.1 403 Forbidden") << of;
  }
  const std::string rebound = "GET /stream HTTP/1.1\r\nHost: evil.example\r\n" + upgrade + "\r\n";
  EXPECT_EQ(status_of(answer_to(rebound + frame("hi"))), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(server->watchers(), 0U);
  EXPECT_EQ(echo.answered, 0);
}

TEST_F(WebServerTest, takes_few_large_bodies_at_once) {
  const std::string upload = "POST /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 900000\r\n\r\n";
  std::vector<std::unique_ptr<Caller>> callers;
  for (int i = 0; i < 4; ++i) {
    callers.push_back(std::make_unique<Caller>(server->port()));
    callers.back()->send(upload);
    ASSERT_TRUE(turn_until([&] { return callers.back()->has_sent(); }, {callers.back().get()}));
    for (int turns = 0; turns < 50; ++turns) server->poll();
  }
  EXPECT_EQ(status_of(answer_to(upload)), "HTTP/1.1 503 Service Unavailable");
  callers[0].reset();  // gives up
  for (int turns = 0; turns < 50; ++turns) server->poll();
  callers[1]->send(std::string(900'000, 'x'));
  ASSERT_TRUE(turn_until([&] { return echo.answered == 1; }, {callers[1].get()}));
  EXPECT_EQ(echo.last.path, "/upload");
  EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK");
}

TEST_F(WebServerTest, greets_a_client_that_waits_with_its_body) {
  Caller caller(server->port());
  caller.send(
      "POST /p HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 2\r\nConnection: close\r\n\r\n");
  ASSERT_TRUE(turn_until([&] { return caller.heard.find("100 Continue") != std::string::npos; }, {&caller}));
  caller.send("ok");
  ASSERT_TRUE(turn_until([&] { return caller.closed; }, {&caller}));
  EXPECT_EQ(echo.last.body, "ok");
}

TEST_F(WebServerTest, streams_the_newest_message_to_all_who_watch) {
  const auto one = watcher("?hz=60");
  const auto two = watcher("?hz=60");
  EXPECT_EQ(server->watchers(), 2U);
  server->publish("hello");
  ASSERT_TRUE(turn_until([&] { return one->heard.size() >= 7 && two->heard.size() >= 7; }, {one.get(), two.get()}));
  EXPECT_EQ(one->heard, "\x81\x05hello");
  EXPECT_EQ(two->heard, one->heard);
  one->heard.clear();
  one->send(frame("hi"));
  ASSERT_TRUE(turn_until([&] { return !one->heard.empty(); }, {one.get(), two.get()}));
  EXPECT_EQ(one->heard, "\x81\x08heard hi");
  EXPECT_EQ(two->heard, "\x81\x05hello") << "an answer is for who has asked";
  EXPECT_EQ(status_of(answer_to(get("/other",
                                    "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                                    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"))),
            "HTTP/1.1 404 Not Found");
}

// A watcher that reads nothing holds one message and what the operating system keeps, however many there are.
TEST_F(WebServerTest, lets_a_slow_watcher_skip_messages) {
  const auto slow = watcher("?hz=60");
  const auto quick = watcher("?hz=60");
  for (int i = 0; i < 400; ++i) {
    server->publish(std::to_string(i) + std::string(65'000, 'x'));
    for (int turns = 0; turns < 20; ++turns) {
      server->poll();
      quick->look();
    }
    usleep(1000);
  }
  EXPECT_GT(server->skipped(), 100U);
  EXPECT_GT(quick->heard.size(), 10U * 65'000U);
  server->publish("the end");
  const auto has_end = [](const Caller& one) { return one.heard.ends_with("\x81\x07the end"); };
  // It comes when the pace allows, with the next message of the same kind.
  ASSERT_TRUE(turn_until(
      [&] {
        server->publish("the end");
        return has_end(*slow) && has_end(*quick);
      },
      {slow.get(), quick.get()}));
  EXPECT_LT(slow->heard.size(), 100U * 65'000U);
}

TEST_F(WebServerTest, sends_a_watcher_away_that_asks_and_does_not_read_or_says_too_much) {
  const auto greedy = watcher();
  for (int i = 0; i < 200'000; ++i) greedy->send(frame("question"));
  for (int i = 0; i < 200'000 && server->watchers() > 0; ++i) {
    greedy->look(false);
    server->poll();
  }
  EXPECT_EQ(server->watchers(), 0U);
  const auto wordy = watcher();
  wordy->send(std::string("\x81\xFE\xFF\xFF") + std::string(4, '\0') + std::string(65'535, 'x'));
  EXPECT_TRUE(turn_until([&] { return server->watchers() == 0; }, {wordy.get()}));
}

// The owner turns the server only when what the server waits for is ready.
TEST_F(WebServerTest, tells_its_owner_what_to_sleep_for) {
  const auto is_ready = [&] {
    std::vector<pollfd> all;
    server->add_to(all);
    return poll(all.data(), all.size(), 0) > 0;
  };
  const auto one = watcher("?hz=60");
  Caller uploads(server->port());
  Caller downloads(server->port());
  uploads.send(
      "POST /upload HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 900000\r\nConnection: "
      "close\r\n\r\n" +
      std::string(900'000, 'x'));
  downloads.send(get("/large"));
  one->send(frame("hi"));
  const auto is_done = [&] { return uploads.closed && downloads.closed && !one->heard.empty(); };
  for (int i = 0; i < 200'000 && !is_done(); ++i) {
    for (Caller* const each : {&uploads, &downloads, one.get()}) each->look();
    if (is_ready()) server->poll();
    if (i > 1000) usleep(100);
  }
  EXPECT_TRUE(is_done());
  EXPECT_GT(downloads.heard.size(), 8'000'000U);
  EXPECT_TRUE(turn_until([&] { return server->connections() == 0; }, {one.get()}));
  EXPECT_FALSE(is_ready()) << "nobody wants anything: the owner would never sleep";
}

TEST_F(WebServerTest, outlives_clients_that_go_amid_everything) {
  for (int i = 0; i < 50; ++i) {
    Caller caller(server->port());
    caller.send(get("/large"));
    caller.look();
    for (int turns = 0; turns < i; ++turns) server->poll(1);
  }
  EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK");
  EXPECT_TRUE(turn_until([&] { return server->connections() == 0; }, {}));
}

TEST_F(WebServerTest, outlives_random_bytes) {
  std::mt19937_64 random(test::seed());
  const std::string pieces[] = {"GET ",
                                "POST ",
                                "/",
                                "/stream ",
                                " HTTP/1.1",
                                "\r\n",
                                "\r\n\r\n",
                                "Host: localhost",
                                "\r\nUpgrade: websocket",
                                "\r\nConnection: Upgrade",
                                "\r\nSec-WebSocket-Key: x",
                                "\r\nTransfer-Encoding: chunked",
                                "\r\nContent-Length: ",
                                "99999999999999999999",
                                "-1",
                                "fffffffffffffffff\r\n",
                                "0\r\n",
                                "\x81\xFF",
                                " ",
                                ":"};
  for (int trial = 0; trial < 300; ++trial) {
    Caller caller(server->port());
    std::string bytes;
    for (int i = 0; i < 12; ++i) {
      bytes += random() % 6 == 0 ? std::string(1 + random() % 9, static_cast<char>(random()))
                                 : pieces[random() % std::size(pieces)];
    }
    caller.send(bytes);
    for (int turns = 0; turns < 20; ++turns) {
      caller.look();
      server->poll();
    }
  }
  EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK");
}

class ShortPatience : public WebServerTest {
 protected:
  ShortPatience() : WebServerTest({.stream_dead_after = std::chrono::seconds(1)}) {}
};

// A client that answers no ping is gone, though its connection was never closed, and whether it reads or not. Its owner
// hears which one it was.
TEST_F(ShortPatience, sends_away_a_watcher_that_answers_no_more) {
  const auto reads = watcher();
  const auto sleeps = watcher();
  reads->send(frame("hi"));
  ASSERT_TRUE(turn_until([&] { return echo.speaker != 0; }, {reads.get()}));
  const std::uint64_t first = echo.speaker;
  sleeps->send(frame("hi"));
  ASSERT_TRUE(turn_until([&] { return echo.speaker != first; }, {sleeps.get()}));
  EXPECT_TRUE(turn_until([&] { return echo.left.size() == 2; }, {reads.get()}));
  EXPECT_THAT(echo.left, testing::UnorderedElementsAre(first, echo.speaker));
  EXPECT_EQ(server->connections(), 0U);
}

// Nobody can be let in: the server waits, and lets its owner sleep meanwhile.
TEST_F(WebServerTest, does_not_wake_its_owner_for_a_newcomer_it_cannot_let_in) {
  const auto page = watcher();
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  std::vector<int> taken;
  Caller newcomer(server->port());
  taken.push_back(dup(0));
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(taken.back()) + 1;
  setrlimit(RLIMIT_NOFILE, &none);
  server->poll();
  std::vector<pollfd> all;
  server->add_to(all);
  const int ready = poll(all.data(), all.size(), 0);
  EXPECT_EQ(ready, 0) << "the owner would spin";
  EXPECT_EQ(server->connections(), 1U);
  page->send(frame("hi"));
  EXPECT_TRUE(turn_until([&] { return !page->heard.empty(); }, {page.get()})) << "who is there goes on";
  setrlimit(RLIMIT_NOFILE, &before);
  newcomer.send(get("/"));
  EXPECT_TRUE(turn_until([&] { return newcomer.closed; }, {&newcomer}));
  EXPECT_EQ(status_of(newcomer.heard), "HTTP/1.1 200 OK");
  for (const int one : taken) close(one);
}

class FewConnections : public WebServerTest {
 protected:
  FewConnections() : WebServerTest({.connections = 3, .watchers = 2, .header_within = std::chrono::seconds(1)}) {}
  bool has(std::size_t number) {
    return turn_until([&] { return server->connections() == number; }, {});
  }
};

TEST_F(FewConnections, go_from_who_has_not_asked_to_who_comes) {
  Caller one(server->port());
  ASSERT_TRUE(has(1));
  Caller two(server->port());
  Caller three(server->port());
  ASSERT_TRUE(has(3));
  EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK");
  EXPECT_TRUE(turn_until([&] { return one.closed; }, {&one})) << "it has waited longest";
  two.look();
  EXPECT_FALSE(two.closed);
  EXPECT_TRUE(turn_until([&] { return server->connections() == 0; }, {&two, &three})) << "within a second";
}

TEST_F(FewConnections, stay_with_who_is_sending_while_others_have_not_asked) {
  Caller sends(server->port());
  sends.send("POST /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\nConnection: close\r\n\r\nhalf");
  ASSERT_TRUE(turn_until([&] { return sends.has_sent() && server->connections() == 1; }, {&sends}));
  server->poll();
  for (int i = 0; i < 10; ++i) {
    std::vector<std::unique_ptr<Caller>> slow;
    for (int k = 0; k < 5; ++k) {
      slow.push_back(std::make_unique<Caller>(server->port()));
      slow.back()->send("GET / HT");
      slow.back()->look();
    }
    EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK");
  }
  sends.send(" done");
  EXPECT_TRUE(turn_until([&] { return sends.closed; }, {&sends}));
  EXPECT_TRUE(sends.heard.ends_with("POST /upload half done")) << sends.heard;
}

// Those who send half of something, and those who do not read their answers, go too.
TEST_F(FewConnections, go_to_who_comes_however_slow_the_others_are) {
  std::vector<std::unique_ptr<Caller>> slow;
  for (int i = 0; i < 30; ++i) {
    slow.push_back(std::make_unique<Caller>(server->port()));
    slow.back()->send(i % 2 == 0 ? get("/large")
                                 : "POST /upload HTTP/1.1\r\nHost: localhost\r\nContent-Length: 9\r\n\r\nhalf");
    for (int k = 0; k < 20; ++k) {
      slow.back()->look(false);
      server->poll();
    }
    EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK") << i;
  }
}

TEST_F(FewConnections, are_not_all_for_those_who_watch) {
  const auto one = watcher();
  const auto two = watcher();
  const std::string upgrade =
      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  EXPECT_EQ(status_of(answer_to(get("/stream", upgrade))), "HTTP/1.1 503 Service Unavailable");
  EXPECT_EQ(status_of(answer_to(get("/"))), "HTTP/1.1 200 OK");
  one->send(frame("hold"));
  EXPECT_TRUE(turn_until([&] { return echo.heard == 1; }, {one.get()}));
}

TEST(WebServer, tells_why_it_cannot_listen) {
  Echo echo;
  const auto first = WebServer::listen("127.0.0.1", 0, {.names = {}, .token = ""}, echo);
  ASSERT_TRUE(first);
  const auto again = WebServer::listen("127.0.0.1", (*first)->port(), {.names = {}, .token = ""}, echo);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().find("in use"), std::string::npos) << again.error();
}

}  // namespace
}  // namespace passo
