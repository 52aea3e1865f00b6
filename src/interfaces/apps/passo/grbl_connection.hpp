// GrblConnection: a connected Grbl board without a session: it is asked for its properties, settings and files. Only a
// file that the board runs by itself moves the machine. Motion that Passo sends needs a GrblMachineConnection.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "grbl_machine_connection.hpp"

#include "passo/machine_file/machine_description.hpp"
#include "passo/sender/file_upload.hpp"
#include "passo/sender/grbl_sender.hpp"

namespace passo {

// Returns whether an address of --board identifies such a machine.
bool names_grbl_machine(const std::string& board);
// Returns what a command with this --board does with its machine.
MachineUse use_with(const std::string& board);

class GrblConnection {
 public:
  static constexpr Seconds between_looks{0.02};

  // Opens `board`, and waits until the controller has identified itself. Null, with a message and `code`, if there is
  // none, or if another program drives it. The machine may be in an alarm.
  static std::unique_ptr<GrblConnection> open(const std::string& board, int& code);

  GrblSender& sender() { return sender_; }
  const GrblSender& sender() const { return sender_; }
  Seconds now() const { return link_.port->now(); }
  // Sends pending data and processes received data, for at most `most`.
  void poll(Seconds most);
  // Sends a file. Returns false, with a message and `code`, if the board has not received it.
  [[nodiscard]] bool upload(FileUpload upload, int& code);
  // Asks a question, and waits for the answer. Empty, with a message and `code`, if there is none.
  std::optional<GrblAnswer> ask(const std::string& line, Seconds most, int& code);
  // Shows why the board does not answer. Returns the exit code.
  [[nodiscard]] int give_up() const;

 private:
  GrblConnection(std::string board, GrblLink link)
      : board_(std::move(board)), link_(std::move(link)), sender_(link_.port->now()) {}

  [[nodiscard]] bool greet(int& code);

  std::string board_;
  GrblLink link_;
  GrblSender sender_;
};

}  // namespace passo
