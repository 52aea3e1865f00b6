// Starts `passo serve --http`, and communicates with it over a socket.
#pragma once

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "kit/served_board.hpp"
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo::test {

class ServedHttp : public ServedBoard {
 protected:
  ~ServedHttp() override { end(); }

  void serve(const std::vector<std::string>& more = {}) {
    const std::string said = path("http-said");
    write("http-said", "");
    server_ = fork();
    if (server_ == 0) {
      if (std::freopen(said.c_str(), "w", stdout) == nullptr) _exit(1);
      std::vector<std::string> words = {program_, "serve", "--http", "127.0.0.1:0"};
      words.insert(words.end(), more.begin(), more.end());
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(program_.c_str(), arguments.data());
      _exit(1);
    }
    for (int i = 0; i < 1000 && read(said).find("Ctrl-C") == std::string::npos; ++i) usleep(10'000);
    port_ = port_behind("http://127.0.0.1:");
    ASSERT_NE(port_, 0) << read(said);
  }
  int end(int signal = SIGTERM) {
    if (server_ <= 0) return 0;
    int status = 0;
    kill(server_, signal);
    waitpid(server_, &status, 0);
    server_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  // Returns a socket connected to the daemon, or -1. `door`: the text that the daemon prints before the port number.
  int connected(const std::string& door = "http://127.0.0.1:") const {
    const int line = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(door.starts_with("http") ? port_ : port_behind(door)));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(line, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return line;
    close(line);
    return -1;
  }
  // Returns the whole response: headers and body.
  std::string ask(const std::string& method, const std::string& path, const std::string& body = "",
                  const std::string& headers = "") const {
    const int line = connected();
    if (line < 0) return "nobody is there";
    const std::string text =
        method + " " + path +
        " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" +
        headers + "\r\n" + body;
    static_cast<void>(send(line, text.data(), text.size(), MSG_NOSIGNAL));
    std::string answer;
    char bytes[4096];
    for (ssize_t got = 0; (got = recv(line, bytes, sizeof bytes, 0)) > 0;) {
      answer.append(bytes, static_cast<std::size_t>(got));
    }
    close(line);
    return answer;
  }
  nlohmann::json json(const std::string& method, const std::string& path, const std::string& body = "",
                      const std::string& headers = "") const {
    const std::string answer = ask(method, "/api/v1" + path, body, headers);
    return nlohmann::json::parse(answer.substr(std::min(answer.find("\r\n\r\n"), answer.size())), nullptr, false);
  }
  pid_t pid() const { return server_; }
  // Takes control, and returns the header that proves it.
  std::string new_key() const { return "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n"; }
  template <class Condition>
  bool until(Condition condition) {
    for (int i = 0; i < 3000 && !condition(); ++i) usleep(10'000);
    return condition();
  }

  std::string program_ = PASSO_PROGRAM;  // the program that serves

 private:
  int port_behind(const std::string& words) const {
    const std::string text = read(path("http-said"));
    const std::size_t at = text.find(words);
    return at == std::string::npos ? 0 : std::stoi(text.substr(at + words.size()));
  }

  pid_t server_ = 0;
  int port_ = 0;
};

}  // namespace passo::test
