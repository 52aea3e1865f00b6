// Any bytes of a client at the socket of a server: the server goes on, and what it answers is HTTP.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/web/web_server.hpp"

namespace passo {
namespace {

constexpr int turns = 60;

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

class Echo final : public WebHandler {
 public:
  WebService find(const WebRequest& head) override {
    return {.longest_body = head.path == "/upload" ? std::size_t{100'000} : std::size_t{100},
            .is_stream = head.path == "/stream",
            .answer = [](const WebRequest& request) { return WebAnswer{.type = "text/plain", .body = request.body}; }};
  }
  WebAnswer refusal(unsigned status) override { return {.status = status, .type = "text/plain", .body = "refused"}; }
  bool is_public(const WebRequest& request) override { return request.path == "/"; }
  std::string hear(std::string_view message, std::uint64_t) override { return std::string(message); }
};

// A client that sends bytes, and leaves without a word.
class Caller {
 public:
  Caller(unsigned port, std::string_view bytes) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    constexpr linger at_once{.l_onoff = 1, .l_linger = 0};
    static_cast<void>(setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once));
    require(connect(socket_, reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0, "nobody listens");
    static_cast<void>(send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;
  ~Caller() { close(socket_); }

  void look() {
    char bytes[4096];
    const ssize_t got = recv(socket_, bytes, sizeof bytes, MSG_DONTWAIT);
    if (got > 0 && heard_.size() < sizeof bytes) heard_.append(bytes, static_cast<std::size_t>(got));
  }
  const std::string& heard() const { return heard_; }

 private:
  int socket_;
  std::string heard_;
};

// The server is begun once: systems have some thousand ports.
WebServer& server() {
  static Echo echo;
  static const std::unique_ptr<WebServer> server =
      std::move(*WebServer::listen("127.0.0.1", 0, {.names = {"localhost"}, .token = "token"}, echo));
  return *server;
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::Caller caller(passo::server().port(), {reinterpret_cast<const char*>(data), size});
  for (int i = 0; i < passo::turns; ++i) {
    passo::server().poll();
    passo::server().publish("news");
    caller.look();
  }
  passo::require(caller.heard().empty() || caller.heard().starts_with("HTTP/1.1 "), "an answer that is not HTTP");
  return 0;
}
