// GrblConnection: a connected machine with a Grbl 1.1 controller, over a serial port or a network connection.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "board_claim.hpp"

#include "passo/sender/file_upload.hpp"
#include "passo/sender/grbl_sender.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {

// Returns whether an address of --board identifies such a machine.
bool names_grbl_machine(const std::string& board);

class GrblConnection {
 public:
  static constexpr Seconds between_looks{0.02};

  // Opens `board`, and waits until the controller has identified itself. Null, with a message and `code`, if there is
  // none, or if another program drives it. The machine may be in an alarm.
  static std::unique_ptr<GrblConnection> open(const std::string& board, int& code);

  GrblSender& sender() { return sender_; }
  const GrblSender& sender() const { return sender_; }
  Seconds now() const { return port_->elapsed(); }
  // Sends pending data and processes received data, for at most `most`.
  void poll(Seconds most);
  // Polls until the machine has executed all lines and is idle, or reports a fault. Ctrl-C brakes, and drops the
  // remaining lines. Shows requests to the operator. `look`, if set, is called after each turn. Returns false if it was
  // interrupted, or if there is a fault.
  [[nodiscard]] bool poll_until_rest(const std::function<void()>& look = {});
  // Returns the request to the operator, if it is new: once for each wait.
  std::string_view news_of_wait();
  // Shows why the machine is not idle with all lines executed. Returns the exit code.
  [[nodiscard]] int give_up() const;
  // Unlocks the machine by homing it, or one axis. Returns false, with a message, on failure.
  [[nodiscard]] bool home(int& code, std::optional<Axis> axis = {});
  // Sends a file. Returns false, with a message and `code`, if the board has not received it.
  [[nodiscard]] bool upload(FileUpload upload, int& code);
  // Asks a question, and waits for the answer. Empty, with a message and `code`, if there is none.
  std::optional<GrblAnswer> ask(const std::string& line, Seconds most, int& code);
  // Returns "X1.000 Y2.000 Z0.000", all axes of the machine, machine coordinates; or that the position is unknown.
  std::string place_words() const;

 private:
  GrblConnection(std::string board, BoardClaim claim, std::unique_ptr<StreamPort> port)
      : board_(std::move(board)), claim_(std::move(claim)), port_(std::move(port)), sender_(port_->elapsed()) {}

  [[nodiscard]] bool greet(int& code);

  std::string board_;
  BoardClaim claim_;
  std::unique_ptr<StreamPort> port_;
  GrblSender sender_;
  std::string_view last_wait_;
};

// Describes the fault: position in the program, cause and code.
std::string describe(const GrblFault& fault, const std::string& program);

}  // namespace passo
