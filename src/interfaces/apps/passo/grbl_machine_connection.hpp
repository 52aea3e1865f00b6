// GrblMachineConnection: a machine session on a Grbl board, over a serial port or a network connection.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "board_claim.hpp"

#include "passo/machine_file/machine_description.hpp"
#include "passo/sender/grbl_machine_session.hpp"
#include "passo/sender/grbl_port.hpp"
#include "passo/transport/serial_ports.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {

// The bytes of a Grbl board in real time. A connection that broke stays so until open_again(): opening a serial port
// may reset the board. A network connection may take seconds to open, so that happens in a thread of its own. A USB
// device is found under another name, too.
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
  BoardAddress opened_at_;
  std::unique_ptr<StreamPort> port_;
  bool broken_ = false;
  std::future<Result<std::unique_ptr<StreamPort>, std::string>> opening_;  // valid while it is being opened
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The open line to a board, which no other program of ours may use.
struct GrblLink {
  // Empty, with a message and `code`, if there is no such board, or if another program drives it. `system`: for
  // list_serial_ports().
  static std::optional<GrblLink> open(const std::string& board, int& code, const std::string& system = "");

  BoardClaim claim;
  std::unique_ptr<GrblStreamPort> port;
};

class GrblMachineConnection {
 public:
  // Opens `board`, and waits until the machine is ready; it may be locked by an alarm. Null, with a message and `code`,
  // if it does not answer as a Grbl board, or if another program drives it. `machine` must outlive the connection.
  // `ahead`: how much motion may lie in the board. `system`: for list_serial_ports().
  static std::unique_ptr<GrblMachineConnection> open(const std::string& board, const MachineDescription& machine,
                                                     Seconds ahead, int& code, const std::string& system = "");

  GrblMachineSession& session() { return session_; }
  // Polls the session once, for at most `most`, and shows what the board says, and what the operator must do at it.
  // Ctrl-C stops the activity.
  void poll(Seconds most);
  // Polls until the session has nothing to do.
  void poll_until_done();
  // Returns "Grbl 1.1h.20190830 on /dev/ttyUSB0".
  std::string words() const;

 private:
  GrblMachineConnection(std::string board, GrblLink link, const MachineDescription& machine, Seconds ahead)
      : board_(std::move(board)), link_(std::move(link)), session_(machine, *link_.port, ahead) {}

  std::string board_;
  GrblLink link_;
  GrblMachineSession session_;
  std::string_view last_wait_;
  bool stops_ = false;
};

// False, with a message: the machine file describes a spindle that this computer would control.
bool leaves_spindle_to_grbl(const MachineDescription& machine);

// Returns "X1.000 Y2.000 Z0.000", all axes of the board, machine coordinates; or that the position is unknown.
std::string place_words(const GrblSender& sender);
// Describes a fault: position in the program, cause and code.
std::string describe(const GrblFault& fault, const std::string& program);
// Shows the errors and warnings among the messages of a board.
void note_trouble(const std::string& board, const std::vector<std::string>& messages);
void note_unknown_firmware(const std::string& board, const GrblMachine& machine);

}  // namespace passo
