// The real ones: Grbl 1.1h on an emulated Uno, and grblHAL's simulator, as processes of their own. Both are in
// ../shared/peers/grbl; tests skip where it is absent.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "kit/grbl_conversations.hpp"
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo::test {

inline const std::string grbl_peers = PASSO_SOURCE_DIR "/../shared/peers/grbl";
inline bool has_grbl_peers() {
  return std::filesystem::exists(grbl_peers);
}

// A process that is killed at the end. Its standard input can be written.
class ChildProcess {
 public:
  ChildProcess(const std::vector<std::string>& words, const std::string& folder,
               const std::string& output = "/dev/null") {
    int ends[2] = {-1, -1};
    if (pipe(ends) != 0) return;
    pid_ = fork();
    if (pid_ == 0) {
      std::vector<char*> all;
      for (const std::string& word : words) all.push_back(const_cast<char*>(word.c_str()));
      all.push_back(nullptr);
      const int out = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (dup2(ends[0], 0) < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || chdir(folder.c_str()) != 0) _exit(127);
      close(ends[1]);
      execv(all[0], all.data());
      _exit(127);
    }
    close(ends[0]);
    input_ = ends[1];
  }
  ~ChildProcess() {
    if (pid_ > 0) kill(pid_, SIGKILL);
    if (pid_ > 0) waitpid(pid_, nullptr, 0);
    if (input_ >= 0) close(input_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void write(std::string_view text) const { static_cast<void>(!::write(input_, text.data(), text.size())); }

 private:
  pid_t pid_ = -1;
  int input_ = -1;
};

// Talks over a descriptor. Closes it at the end.
class RealTalker final : public GrblTalker {
 public:
  explicit RealTalker(int line) : line_(line) {}
  ~RealTalker() override { close(line_); }
  std::string ask(std::string_view bytes, std::size_t lines) override {
    static_cast<void>(!::write(line_, bytes.data(), bytes.size()));
    return listen(lines, std::chrono::seconds(bytes == "?" ? 1 : 3));
  }
  std::string listen(std::size_t lines, std::chrono::milliseconds most) const {
    constexpr auto quiet = std::chrono::milliseconds(20);
    std::string said;
    std::array<char, 4096> buffer{};
    auto silent_since = std::chrono::steady_clock::now();
    const auto end = silent_since + most;
    for (;;) {
      const auto now = std::chrono::steady_clock::now();
      const auto heard = static_cast<std::size_t>(std::count(said.begin(), said.end(), '\n'));
      if (now > end || (heard >= lines && now - silent_since > quiet)) return said;
      pollfd wanted{.fd = line_, .events = POLLIN, .revents = 0};
      if (poll(&wanted, 1, 5) <= 0) continue;
      const ssize_t count = ::read(line_, buffer.data(), buffer.size());
      if (count <= 0) return said;
      said.append(buffer.data(), static_cast<std::size_t>(count));
      silent_since = std::chrono::steady_clock::now();
    }
  }

 private:
  int line_;
};

// Builds the emulated Uno; empty: it does not build here.
inline std::string built_uno(const std::string& folder) {
  const std::string program = folder + "/uno";
  const std::string command = grbl_peers + "/build.sh " + program + " >/dev/null 2>&1";
  return std::system(command.c_str()) == 0 ? program : "";
}

inline int open_when_there(const std::string& path) {
  for (int i = 0; i < 200 && !std::filesystem::exists(path); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  return open(path.c_str(), O_RDWR | O_NOCTTY);
}

inline int connect_when_there(int port) {
  for (int i = 0; i < 100; ++i) {
    const int line = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(line, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return line;
    close(line);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return -1;
}

}  // namespace passo::test
