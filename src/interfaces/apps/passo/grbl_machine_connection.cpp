#include "grbl_machine_connection.hpp"

#include <cstdint>
#include <thread>
#include <utility>

#include "commands.hpp"
#include "machine_connection.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>

namespace passo {

Seconds GrblStreamPort::now() const {
  return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
}

void GrblStreamPort::send(std::string_view bytes) {
  if (!broken_) port_->receive({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  broken_ = broken_ || port_->broken();
}

std::string GrblStreamPort::receive(Seconds most) {
  if (broken_) {
    std::this_thread::sleep_for(std::chrono::duration<double>(most.value()));
    return {};
  }
  const bool has_come = port_->run(most);
  broken_ = port_->broken();
  if (!has_come) return {};
  const auto came = port_->replies();
  return {reinterpret_cast<const char*>(came.data()), came.size()};
}

bool GrblStreamPort::open_again() {
  if (!opening_.valid())
    opening_ = std::async(std::launch::async, [address = address_] { return open_board(address); });
  if (opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  auto port = opening_.get();
  if (!port) return false;
  port_ = std::move(*port);
  broken_ = false;
  return true;
}

std::optional<GrblLink> GrblLink::open(const std::string& board, int& code) {
  const auto address = parse_board_address(board);
  if (!address) {
    code = fail(exit_bad_program, address.error());
    return std::nullopt;
  }
  auto claim = BoardClaim::acquire(*address);
  if (!claim) {
    code = fail(exit_failed, claim.error());
    return std::nullopt;
  }
  auto port = open_board(*address);
  if (!port) {
    code = fail(exit_failed, port.error());
    return std::nullopt;
  }
  return GrblLink{.claim = std::move(*claim), .port = std::make_unique<GrblStreamPort>(*address, std::move(*port))};
}

std::unique_ptr<GrblMachineConnection> GrblMachineConnection::open(const std::string& board,
                                                                   const MachineDescription& machine, Seconds ahead,
                                                                   int& code) {
  auto link = GrblLink::open(board, code);
  if (!link) return nullptr;
  std::unique_ptr<GrblMachineConnection> opened(new GrblMachineConnection(board, std::move(*link), machine, ahead));
  GrblMachineSession& session = opened->session_;
  while (session.state() == MachineState::offline && interrupted_by() == 0) {
    opened->poll(GrblMachineSession::between_looks);
  }
  if (session.state() == MachineState::idle || session.state() == MachineState::door) {
    note_unknown_firmware(board, session.board());
    return opened;
  }
  code = interrupted_by() != 0 || !session.fault()
             ? exit_of_signal()
             : fail(exit_failed, fmt::format("{}: {}", board, describe(*session.fault(), "")));
  return nullptr;
}

void GrblMachineConnection::poll(Seconds most) {
  if (interrupted_by() != 0 && session_.busy() && !std::exchange(stops_, true)) {
    try_request(session_, request::Stop{});
  }
  session_.poll(most);
  const auto tell = [](const std::string& words) {
    ProgressDisplay::clear_shown();
    note(words);
  };
  for (const std::string& message : session_.take_messages()) {
    const bool is_trouble = message.starts_with("ERR") || message.starts_with("WARN");  // of FluidNC
    if (is_trouble) tell(fmt::format("{}: the board says: {}", board_, message));
  }
  const std::string_view wait = session_.sender().waits_for();
  if (std::exchange(last_wait_, wait) != wait && !wait.empty()) tell(std::string(wait));
}

void GrblMachineConnection::poll_until_done() {
  // What was asked of a board that is lost or in an alarm is never answered.
  const auto waits = [&] { return session_.busy() || (session_.state() == MachineState::idle && session_.works()); };
  while (waits()) poll(GrblMachineSession::between_looks);
}

std::string GrblMachineConnection::words() const {
  const GrblMachine& board = session_.board();
  return fmt::format("{} {} on {}", board.firmware, board.version, board_);
}

std::string GrblMachineConnection::place_words() const {
  const auto place = session_.sender().place();
  if (!place) return "an unknown position";
  std::string words;
  AxisSet told;
  for (const char letter : session_.board().axes) {
    const auto axis = axis_of(letter);
    if (!axis || told.has(*axis)) continue;
    told.add(*axis);
    words += fmt::format("{}{}{:.3f}", words.empty() ? "" : " ", letter, (*place)[*axis]);
  }
  return words;
}

std::string describe(const GrblFault& fault, const std::string& program) {
  std::string where;
  if (fault.last_line != 0 && !program.empty()) {
    where = fault.first_line < fault.last_line
                ? fmt::format("{}, between line {} and line {}: ", program, fault.first_line, fault.last_line)
                : fmt::format("{}:{}: ", program, fault.last_line);
  }
  return fmt::format("{}{} [{}]", where, fault.message, fault.code);
}

void note_unknown_firmware(const std::string& board, const GrblMachine& machine) {
  if (machine.is_known()) return;
  note(fmt::format("{}: Passo does not know the firmware {} {}, and treats it as Grbl 1.1", board, machine.firmware,
                   machine.version));
}

}  // namespace passo
