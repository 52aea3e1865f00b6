#include "grbl_machine_connection.hpp"

#include <cstdint>
#include <thread>

#include "commands.hpp"
#include "program_input.hpp"
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
  auto port = open_board(address_);
  if (!port) return false;
  port_ = std::move(*port);
  broken_ = false;
  return true;
}

std::unique_ptr<GrblMachineConnection> GrblMachineConnection::open(const std::string& board,
                                                                   const MachineDescription& machine, int& code) {
  const auto address = parse_board_address(board);
  if (!address) {
    code = fail(exit_bad_program, address.error());
    return nullptr;
  }
  auto claim = BoardClaim::acquire(*address);
  if (!claim) {
    code = fail(exit_failed, claim.error());
    return nullptr;
  }
  auto port = open_board(*address);
  if (!port) {
    code = fail(exit_failed, port.error());
    return nullptr;
  }
  std::unique_ptr<GrblMachineConnection> opened(
      new GrblMachineConnection(board, std::move(*claim), *address, std::move(*port), machine));
  GrblMachineSession& session = opened->session_;
  while (session.state() == MachineState::offline && interrupted_by() == 0) {
    session.poll(GrblMachineSession::between_looks);
  }
  if (session.state() == MachineState::idle || session.state() == MachineState::door) return opened;
  const Sentence trouble = session.status().trouble_sentence;
  code = interrupted_by() != 0 ? exit_of_signal()
                               : fail(exit_failed, fmt::format("{}: {} [{}]", board, trouble.text, trouble.code));
  return nullptr;
}

std::string GrblMachineConnection::words() const {
  const GrblMachine& board = session_.board();
  return fmt::format("{} {} on {}", board.firmware, board.version, board_);
}

}  // namespace passo
