// GrblConnection: a connected Grbl board that is asked for its properties and settings, and moves nothing. Where it is
// to move, GrblMachineConnection has a session.
#pragma once

#include <memory>
#include <string>

#include "grbl_machine_connection.hpp"

#include "passo/sender/grbl_sender.hpp"

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
  // Sends pending data and processes received data, for at most `most`.
  void poll(Seconds most);

 private:
  explicit GrblConnection(GrblLink link) : link_(std::move(link)), sender_(link_.port->now()) {}

  GrblLink link_;
  GrblSender sender_;
};

}  // namespace passo
