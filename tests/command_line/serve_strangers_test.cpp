// A web page at the sender port: a browser lets any page send a request there, and none of it may reach the machine.
#include <csignal>
#include <filesystem>
#include <string>

#include "kit/command_line.hpp"
#include "kit/shared_case.hpp"
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

namespace {

using passo::test::read;
using namespace std::string_literals;

class Strangers : public passo::test::CommandLine {
 protected:
  Strangers() {
    const std::string said = path("said");
    write("said", "");
    server_ = fork();
    if (server_ == 0) {
      if (std::freopen(said.c_str(), "w", stdout) == nullptr) _exit(1);
      const std::string data = path("data");
      std::filesystem::create_directories(data);
      write("data/grbl.txt", "$N0=G91G0X5\n");  // a start line moves when a sender has come
      execl(PASSO_PROGRAM, PASSO_PROGRAM, "serve", "--grbl-tcp", "127.0.0.1:0", "--http", "127.0.0.1:0", "--data",
            data.c_str(), nullptr);
      _exit(1);
    }
    for (int i = 0; i < 1000 && read(said).find("Ctrl-C") == std::string::npos; ++i) usleep(10'000);
    grbl_port_ = port_after("tcp:127.0.0.1:");
    http_port_ = port_after("http://127.0.0.1:");
  }
  ~Strangers() override {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }

  static int call(int port) {
    const int line = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(line, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return line;
  }
  static void say(int line, const std::string& text) {
    static_cast<void>(send(line, text.data(), text.size(), MSG_NOSIGNAL));
  }
  // Until the other side hangs up, or `end` has come.
  static std::string hear(int line, const std::string& end = "") {
    std::string all;
    char bytes[4096];
    while (end.empty() || all.find(end) == std::string::npos) {
      const ssize_t got = recv(line, bytes, sizeof bytes, 0);
      if (got <= 0) break;
      all.append(bytes, static_cast<std::size_t>(got));
    }
    return all;
  }
  // Until the port is free for the next one.
  int call_at_last() const {
    for (int i = 0; i < 500; ++i, usleep(10'000)) {
      const int line = call(grbl_port_);
      if (hear(line, "]\r\n").find("Grbl 1.1") != std::string::npos) return line;
      close(line);
    }
    return -1;
  }
  nlohmann::json status() const {
    const int line = call(http_port_);
    say(line, "GET /api/v1/status HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n");
    const std::string answer = hear(line);
    close(line);
    return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n")), nullptr, false);
  }

  int grbl_port_ = 0;
  int http_port_ = 0;

 private:
  int port_after(const std::string& words) const {
    const std::string said = read(path("said"));
    const std::size_t at = said.find(words);
    return at == std::string::npos ? 0 : std::stoi(said.substr(at + words.size()));
  }

  pid_t server_ = 0;
};

TEST_F(Strangers, move_nothing_switch_nothing_and_shift_nothing) {
  const std::string body = "\r\n\r\nM3S12000\nG10L2P1X-50\nG91G0X30\n$N1=G0X9\n~";
  const nlohmann::json before = status();
  for (const std::string& first :
       {"POST / HTTP/1.1\r\nOrigin: http://evil.example"s, "GET /?~ HTTP/1.1"s, "OPTIONS * HTTP/1.1"s,
        "PRI * HTTP/2.0"s, "\x16\x03\x01\x02\x00"s, "SSH-2.0-x"s, "OPTIONS rtsp://a RTSP/1.0"s}) {
    const int stranger = call_at_last();
    ASSERT_GE(stranger, 0);
    say(stranger, first.substr(0, 2));
    usleep(30'000);
    say(stranger, first.substr(2) + body);
    EXPECT_EQ(hear(stranger), "") << first << ": it is sent away without an answer";
    close(stranger);
  }
  const nlohmann::json after = status();
  for (const char* const what : {"state", "place", "work_offset", "outputs", "owner"}) {
    EXPECT_EQ(after[what], before[what]) << what;
  }
  EXPECT_EQ(read(path("data/grbl.txt")).find("N1=G0X9"), std::string::npos);
  const int sender = call_at_last();
  say(sender, "?");
  EXPECT_THAT(hear(sender, ":ok\r\n"), testing::AllOf(testing::HasSubstr("<Idle|"), testing::HasSubstr(">G91G0X5:ok")))
      << "a sender is answered before it has sent a line, and only now the start lines run";
  close(sender);
}

// The case that found it, as it was found.
TEST_F(Strangers, the_case_of_a_page_s_post) {
  const auto said = passo::test::run_shared_case("http-into-grbl-port.sh", "curl jq nc", path("shown"));
  if (!said) GTEST_SKIP() << "no ../shared/cases, or no curl, jq or nc";
  const std::string& shown = *said;
  int found = 0;
  for (const char* const rests : {"[\"Idle\",0.0,0.0,\"off\"]\n", "[\"Idle\",0,0,\"off\"]\n"}) {  // jq 1.7, jq 1.6
    for (std::size_t at = shown.find(rests); at != std::string::npos; at = shown.find(rests, at + 1)) ++found;
  }
  EXPECT_EQ(found, 3) << shown;
}

}  // namespace
