#include "grbl_connection.hpp"

#include <utility>

#include "commands.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>

namespace passo {

bool names_grbl_machine(const std::string& board) {
  return board.starts_with("grbl:");
}

std::unique_ptr<GrblConnection> GrblConnection::open(const std::string& board, int& code) {
  auto link = GrblLink::open(board, code);
  if (!link) return nullptr;
  std::unique_ptr<GrblConnection> opened(new GrblConnection(std::move(*link)));
  GrblSender& sender = opened->sender_;
  while (!sender.ready() && !sender.fault() && interrupted_by() == 0) opened->poll(between_looks);
  if (sender.ready()) {
    note_unknown_firmware(board, sender.machine());
    return opened;
  }
  code = interrupted_by() != 0 ? exit_of_signal()
                               : fail(exit_failed, fmt::format("{}: {}", board, describe(*sender.fault(), "")));
  return nullptr;
}

void GrblConnection::poll(Seconds most) {
  link_.port->send(sender_.take_bytes(link_.port->now()));
  const std::string came = link_.port->receive(most);
  // A line that is opened anew may reset the machine, so a line that broke stays so.
  if (link_.port->is_broken()) return sender_.lose();
  sender_.receive(came, link_.port->now());
}

}  // namespace passo
