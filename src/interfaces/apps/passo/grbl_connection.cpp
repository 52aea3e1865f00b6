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

MachineUse use_with(const std::string& board) {
  return names_grbl_machine(board) ? MachineUse::any_board : MachineUse::own_board;
}

std::unique_ptr<GrblConnection> GrblConnection::open(const std::string& board, int& code) {
  auto link = GrblLink::open(board, code);
  if (!link) return nullptr;
  std::unique_ptr<GrblConnection> opened(new GrblConnection(board, std::move(*link)));
  if (!opened->greet(code)) return nullptr;
  note_unknown_firmware(board, opened->sender_.machine());
  return opened;
}

bool GrblConnection::greet(int& code) {
  while (!sender_.ready() && !sender_.fault() && interrupted_by() == 0) poll(between_looks);
  if (sender_.ready()) return true;
  code = give_up();
  return false;
}

// The sender is silent during the upload, and asks the board again afterwards.
bool GrblConnection::upload(FileUpload upload, int& code) {
  GrblPort& port = *link_.port;
  bool ended = false;
  while (!ended) {
    if (interrupted_by() != 0) upload.cancel();
    port.send(upload.take_bytes(port.now()));
    ended = upload.ended();
    const std::string came = port.receive(between_looks);
    if (port.is_broken()) {
      code = fail(exit_failed, board_ + ": the connection is lost [grbl.line-lost]");
      return false;
    }
    if (!came.empty()) upload.receive(came, port.now());
  }
  if (!upload.trouble().empty()) {
    code = interrupted_by() != 0 ? exit_of_signal()
                                 : fail(exit_failed, fmt::format("{}: {} [board.upload]", board_, upload.trouble()));
    return false;
  }
  sender_ = GrblSender::on_open_line(port.now());
  return greet(code);
}

std::optional<GrblAnswer> GrblConnection::ask(const std::string& line, Seconds most, int& code) {
  sender_.ask(line, most);
  std::optional<GrblAnswer> answer;
  while (!answer && !sender_.fault() && interrupted_by() == 0) {
    poll(between_looks);
    answer = sender_.take_reply();
  }
  if (!answer) code = give_up();
  return answer;
}

int GrblConnection::give_up() const {
  const auto& fault = sender_.fault();
  const int failed = fault ? fail(exit_failed, fmt::format("{}: {}", board_, describe(*fault, ""))) : exit_failed;
  return fault && interrupted_by() == 0 ? failed : exit_of_signal();
}

void GrblConnection::poll(Seconds most) {
  link_.port->send(sender_.take_bytes(link_.port->now()));
  const std::string came = link_.port->receive(most);
  // Opening the connection again may reset the machine, so a broken one stays broken.
  if (link_.port->is_broken()) return sender_.lose();
  sender_.receive(came, link_.port->now());
  note_trouble(board_, sender_.take_messages());
}

}  // namespace passo
