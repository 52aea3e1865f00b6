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

GrblStreamPort::GrblStreamPort(BoardAddress address, std::unique_ptr<StreamPort> port, std::string system)
    : address_(std::move(address)), system_(std::move(system)), port_(std::move(port)) {
  if (address_.kind != BoardAddress::Kind::serial) return;
  const SerialPortList list = list_serial_ports(system_);
  if (const SerialPort* const found = find_serial_port(list, address_.place)) device_ = *found;
}

// Empty: a USB device is not there.
std::optional<BoardAddress> GrblStreamPort::present_address() const {
  if (!device_) return address_;
  const SerialPortList list = list_serial_ports(system_);
  const SerialPort* const found = find_returned_port(list, *device_);
  if (found == nullptr) return {};
  BoardAddress address = address_;
  if (found->device != device_->device) address.place = found->device;
  return address;
}

bool GrblStreamPort::has_returned() {
  return device_ && present_address().has_value();
}

bool GrblStreamPort::open_again() {
  const auto address = present_address();
  if (!address) return false;
  std::optional<BoardClaim> claim;
  if (address->place != address_.place) {
    auto taken = BoardClaim::acquire(*address);
    if (!taken) return false;
    claim = std::move(*taken);
  }
  auto port = open_board(*address);
  if (!port) return false;
  if (address->place != address_.place)
    note("the board is at " + address->place + " now, instead of " + address_.place);
  renamed_claim_ = std::move(claim);
  port_ = std::move(*port);
  broken_ = false;
  return true;
}

std::unique_ptr<GrblMachineConnection> GrblMachineConnection::open(const std::string& board,
                                                                   const MachineDescription& machine, int& code,
                                                                   const std::string& system) {
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
      new GrblMachineConnection(board, std::move(*claim), *address, std::move(*port), machine, system));
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
