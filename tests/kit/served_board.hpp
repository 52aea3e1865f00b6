// Starts `passo board serve`, a simulated board on the network, for each test that needs one.
#pragma once

#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "kit/command_line.hpp"

namespace passo::test {

class ServedBoard : public CommandLine {
 protected:
  ~ServedBoard() override { end_server(); }

  // The option for a run on a board that was just started, whose machine position is unknown.
  static constexpr const char* from_here = " --from-here ";

  // Starts a board instead of the last one and returns its address. Without a clock it has the machine's, and without a
  // machine three motors.
  std::string serve(const std::string& clock = "16000000", const std::string& machine = "") {
    end_server();
    const std::string said = path("said");
    write("said", "");
    server_ = fork();
    if (server_ == 0) {
      if (std::freopen(said.c_str(), "w", stdout) == nullptr) _exit(1);
      std::vector<std::string> words = {PASSO_PROGRAM, "board", "serve", "--port", "0"};
      if (machine.empty()) words.insert(words.end(), {"--motors", "3"});
      if (!clock.empty()) words.insert(words.end(), {"--clock", clock});
      if (!machine.empty()) words.insert(words.end(), {"--machine", machine});
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(PASSO_PROGRAM, arguments.data());
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

  // Returns the server's exit code, or the negative number of the signal that killed it.
  int end_server(int signal = SIGTERM) {
    if (server_ <= 0) return 0;
    int status = 0;
    kill(server_, signal);
    waitpid(server_, &status, 0);
    server_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  void signal_server(int signal) const { kill(server_, signal); }

 private:
  pid_t server_ = 0;
};

}  // namespace passo::test
