// BoardServer: the line of a board that listens for its host over TCP, on this computer only.
//
// Any number of programs may watch the board; one of them drives it, the host. A program becomes the host when it says
// something that only a host says: a hello, an item, a question for its own motors. Whoever only asks is answered, and
// disturbs nobody. A second host is sent away, but a host that was silent for `most_silence` gives way to it.
//
// A caller whose first byte begins no frame is sent away at once: a web page can make a browser call.
//
// Frames go to the board whole, so half a frame of one program never spoils another's. Nobody makes the board wait: a
// program that does not read what it is told is sent away.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/link/board_port.hpp"
#include "passo/units/units.hpp"
#include "passo/wire/decoder.hpp"

namespace passo {

class BoardServer {
 public:
  // A host that works is heard five times a second.
  static constexpr Seconds most_silence{2};
  static constexpr std::size_t most_clients = 32;

  // Listens for this computer only, because whoever can connect can turn the motors. `port` 0: any that is free. The
  // error is a sentence with the reason.
  static Result<std::unique_ptr<BoardServer>, std::string> listen(unsigned port);
  ~BoardServer();
  BoardServer(const BoardServer&) = delete;
  BoardServer& operator=(const BoardServer&) = delete;

  unsigned port() const { return port_; }
  // Waits until somebody calls, says something or goes, but no longer than `most`.
  void wait(Seconds most) const;
  // Takes those who call, and gives the board what was said. The board's answers go to whoever asked. Does not wait.
  void attend(BoardPort& board);
  // Tells the host what the board says by itself. Without a host nobody is told.
  void send_to_host(std::span<const std::uint8_t> bytes);
  // True: somebody was connected, and nobody is.
  bool all_have_left() const { return anybody_came_ && clients_.empty(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Client {
    int descriptor = -1;
    Decoder decoder;
    std::uint8_t motors = 0;               // for which its messages carry values
    std::vector<std::uint8_t> last_bytes;  // as many as a frame may have
    Clock::time_point heard = Clock::now();
    bool has_spoken = false;
    bool gone = false;
  };

  BoardServer(int listening, unsigned port) : listening_(listening), port_(port) {}
  void accept_clients();
  void hear(Client& client, BoardPort& board);
  void handle(Client& client, const WireFrame& frame, BoardPort& board);
  bool may_drive(const Client& client);
  static void tell(Client& client, std::span<const std::uint8_t> bytes);
  void part_with_the_gone();

  int listening_;
  unsigned port_;
  std::vector<std::unique_ptr<Client>> clients_;
  Client* host_ = nullptr;
  std::uint8_t motors_ = 0;  // of the last hello: a host whose line was broken says none
  bool anybody_came_ = false;
  Clock::time_point accepts_at_;  // not before: there was no room for a caller
};

}  // namespace passo
