// Starts `passo board serve`, a virtual board in the network, for each test that needs one.
#pragma once

#include <csignal>
#include <cstdio>
#include <string>

#include "kit/command_line.hpp"

namespace passo::test {

class ServedBoard : public CommandLine {
 protected:
  ~ServedBoard() override { end_server(); }

  // Where the machine stands on a board that was just started: a run wants to be told.
  static constexpr const char* from_here = " --from-here ";

  // Starts a board in place of the last one and returns its address.
  std::string serve(const std::string& clock = "16000000", const std::string& machine = "") {
    end_server();
    const std::string said = path("said");
    write("said", "");
    server_ = fork();
    if (server_ == 0) {
      if (std::freopen(said.c_str(), "w", stdout) == nullptr) _exit(1);
      execl(PASSO_PROGRAM, PASSO_PROGRAM, "board", "serve", "--port", "0", "--motors", "3", "--clock", clock.c_str(),
            machine.empty() ? nullptr : "--machine", machine.c_str(), nullptr);
      _exit(1);
    }
    for (int i = 0; i < 1000; ++i) {
      const std::string text = read(said);
      const std::size_t at = text.find("tcp:");
      if (at != std::string::npos && text.back() == '\n') return text.substr(at, text.size() - at - 1);
      usleep(10'000);
    }
    return "it did not start";
  }

 private:
  void end_server() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
    server_ = 0;
  }

  pid_t server_ = 0;
};

}  // namespace passo::test
