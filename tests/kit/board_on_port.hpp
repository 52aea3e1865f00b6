// BoardOnPort: runs a board of the kit, such as a StrictGrbl or a FirmwareFake, in real time on a TCP port of this
// computer, for commands under test.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo::test {

template <class Board>
class BoardOnPort {
 public:
  // `each` is called in each iteration, in the machine's thread.
  explicit BoardOnPort(Board machine, std::function<void(Board&)> each = {})
      : machine_(std::move(machine)), each_(std::move(each)), listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    bound_ = bind(listener_, any, size) == 0 && listen(listener_, 1) == 0 && getsockname(listener_, any, &size) == 0;
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~BoardOnPort() {
    ends_ = true;
    thread_.join();
    close(listener_);
  }
  BoardOnPort(const BoardOnPort&) = delete;
  BoardOnPort& operator=(const BoardOnPort&) = delete;

  bool listens() const { return bound_; }
  std::string address() const { return "grbl:tcp:127.0.0.1:" + std::to_string(port_); }

 private:
  using Clock = std::chrono::steady_clock;

  static bool wait_for_input(int socket) {
    pollfd wanted{.fd = socket, .events = POLLIN, .revents = 0};
    return poll(&wanted, 1, 2) > 0;
  }
  void serve() {
    while (!ends_) {
      if (!wait_for_input(listener_)) continue;
      const int line = accept(listener_, nullptr, nullptr);
      machine_.restart();  // like an Arduino when its serial port is opened
      talk(line);
      close(line);
    }
  }
  void talk(int line) {
    std::array<char, 4096> bytes{};
    Clock::time_point last = Clock::now();
    while (!ends_) {
      if (wait_for_input(line)) {
        const ssize_t count = recv(line, bytes.data(), bytes.size(), 0);
        if (count <= 0) return;
        machine_.receive({bytes.data(), static_cast<std::size_t>(count)});
      }
      const Clock::time_point now = Clock::now();
      machine_.run(std::chrono::duration<double>(now - std::exchange(last, now)).count());
      if (each_) each_(machine_);
      const std::string said = machine_.take_output();
      if (!said.empty() && send(line, said.data(), said.size(), MSG_NOSIGNAL) < 0) return;
    }
  }

  Board machine_;
  std::function<void(Board&)> each_;
  int listener_;
  bool bound_ = false;
  unsigned port_ = 0;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace passo::test
