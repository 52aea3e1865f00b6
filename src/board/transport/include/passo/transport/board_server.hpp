// BoardServer: a board's TCP server for its host, reachable from this computer only.
//
// Any number of programs may watch the board; one of them, the host, drives it. A client becomes the host when it sends
// a message that only a host sends: a hello, an item, or a query with positions. Clients that only query are answered,
// without an effect on others. A second host is disconnected, unless the first host has been silent for `most_silence`.
//
// A client whose first byte is not the start of a frame is disconnected at once, because a web page can make a browser
// connect.
//
// The board receives only whole frames, so an incomplete frame of one program never corrupts another's. A client that
// does not read its messages is disconnected, so that it cannot block the board.
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
  // A working host sends something five times a second.
  static constexpr Seconds most_silence{2};
  static constexpr std::size_t most_clients = 32;

  // Listens on this computer only, because every client can move the motors. `port` 0: a free port. The error is a
  // sentence with the reason.
  static Result<std::unique_ptr<BoardServer>, std::string> listen(unsigned port);
  ~BoardServer();
  BoardServer(const BoardServer&) = delete;
  BoardServer& operator=(const BoardServer&) = delete;

  unsigned port() const { return port_; }
  // Waits for a connection, a message or a disconnection, but at most `most`.
  void wait(Seconds most) const;
  // Accepts connections, and passes messages to the board. Each answer goes to the client that sent the query. Does not
  // wait.
  void attend(BoardPort& board);
  // Sends the board's own messages to the host. Without a host they are dropped.
  void send_to_host(std::span<const std::uint8_t> bytes);
  // Returns true if a client was connected, and none is any more.
  bool all_have_left() const { return anybody_came_ && clients_.empty(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Client {
    int descriptor = -1;
    Decoder decoder;
    std::uint8_t motors = 0;               // number of motors in its messages
    std::vector<std::uint8_t> last_bytes;  // the latest bytes, at most the length of a frame
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
  std::uint8_t motors_ = 0;  // number of motors in the last hello; a host that reconnects does not send one
  bool anybody_came_ = false;
  Clock::time_point accepts_at_;  // the earliest time for the next accept: there was no room for a client
};

}  // namespace passo
