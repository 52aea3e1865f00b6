// GrblMachineConnection: a machine session on a Grbl board, over a serial port or a network connection.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "board_claim.hpp"

#include "passo/machine_file/machine_description.hpp"
#include "passo/sender/grbl_machine_session.hpp"
#include "passo/sender/grbl_port.hpp"
#include "passo/transport/serial_ports.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {

// The bytes of a Grbl board in real time. A connection that broke stays so until open_again(): opening a serial port
// may reset the board. A USB device is found under another name, too.
class GrblStreamPort final : public GrblPort {
 public:
  // `system`: for list_serial_ports().
  GrblStreamPort(BoardAddress address, std::unique_ptr<StreamPort> port, std::string system);

  Seconds now() const override;
  void send(std::string_view bytes) override;
  std::string receive(Seconds most) override;
  bool is_broken() const override { return broken_; }
  bool has_returned() override;
  bool open_again() override;

 private:
  std::optional<BoardAddress> present_address() const;

  BoardAddress address_;
  std::string system_;
  std::optional<SerialPort> device_;         // null: no USB port
  std::optional<BoardClaim> renamed_claim_;  // under another name
  std::unique_ptr<StreamPort> port_;
  bool broken_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class GrblMachineConnection {
 public:
  // Opens `board`, and waits until the machine is ready. Null, with a message and `code`, if it does not answer as a
  // Grbl board, or if another program drives it. `machine` must outlive the connection. `system`: for
  // list_serial_ports().
  static std::unique_ptr<GrblMachineConnection> open(const std::string& board, const MachineDescription& machine,
                                                     int& code, const std::string& system = "");

  GrblMachineSession& session() { return session_; }
  // Returns "Grbl 1.1h.20190830 on /dev/ttyUSB0".
  std::string words() const;

 private:
  GrblMachineConnection(std::string board, BoardClaim claim, const BoardAddress& address,
                        std::unique_ptr<StreamPort> port, const MachineDescription& machine, const std::string& system)
      : board_(std::move(board)),
        claim_(std::move(claim)),
        port_(address, std::move(port), system),
        session_(machine, port_) {}

  std::string board_;
  BoardClaim claim_;
  GrblStreamPort port_;
  GrblMachineSession session_;
};

}  // namespace passo
