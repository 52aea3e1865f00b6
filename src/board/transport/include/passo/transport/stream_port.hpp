// StreamPort: a board at the other end of a serial link or a TCP connection, in real time.
//
// Position in the pipeline: the connection to a board outside this process. Only this code opens devices and sockets
// and waits for real time; a link uses a BoardPort and cannot tell it from a virtual line. A broken connection is
// silent and drops all bytes sent, while this code tries repeatedly to open it again. The link decides how long that
// may take (LinkTimeouts).
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/link/board_port.hpp"
#include "passo/transport/board_address.hpp"

namespace passo {

class StreamPort final : public BoardPort {
 public:
  // Takes ownership of an open descriptor. `open_again` returns a new descriptor after the connection broke, or a
  // negative number.
  explicit StreamPort(int descriptor, std::function<int()> open_again = nullptr);
  ~StreamPort() override;
  StreamPort(const StreamPort&) = delete;
  StreamPort& operator=(const StreamPort&) = delete;

  void receive(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool run(Seconds most) override;
  std::span<const std::uint8_t> replies() override;
  Seconds elapsed() const override;

  bool hung_up() const override { return hung_up_; }
  // Whether the device has disappeared or the other side has closed the connection.
  bool broken() const { return broken_; }

 private:
  bool wait_for(short events, Seconds most) const;
  void open_again(Seconds most);

  int descriptor_;
  std::function<int()> open_again_;
  bool broken_ = false;
  bool hung_up_ = false;
  std::vector<std::uint8_t> arrived_;
  std::vector<std::uint8_t> taken_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Opens a serial port or a connection. The error is a sentence with the reason.
Result<std::unique_ptr<StreamPort>, std::string> open_board(const BoardAddress& address);

}  // namespace passo
