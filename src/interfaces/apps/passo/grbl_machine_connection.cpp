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
  if (!opening_.valid()) {
    const auto address = present_address();
    if (!address) return false;
    renamed_claim_.reset();
    if (address->place != address_.place) {
      auto taken = BoardClaim::acquire(*address);
      if (!taken) return false;
      renamed_claim_ = std::move(*taken);
    }
    opened_at_ = *address;
    opening_ = std::async(std::launch::async, [address = opened_at_] { return open_board(address); });
  }
  if (opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
  auto port = opening_.get();
  if (!port) return false;
  if (opened_at_.place != address_.place)
    note("the board is at " + opened_at_.place + " now, instead of " + address_.place);
  port_ = std::move(*port);
  broken_ = false;
  return true;
}

std::optional<GrblLink> GrblLink::open(const std::string& board, int& code, const std::string& system) {
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
  return GrblLink{.claim = std::move(*claim),
                  .port = std::make_unique<GrblStreamPort>(*address, std::move(*port), system)};
}

std::unique_ptr<GrblMachineConnection> GrblMachineConnection::open(const std::string& board,
                                                                   const MachineDescription& machine, Seconds ahead,
                                                                   int& code, const std::string& system) {
  auto link = GrblLink::open(board, code, system);
  if (!link) return nullptr;
  std::unique_ptr<GrblMachineConnection> opened(new GrblMachineConnection(board, std::move(*link), machine, ahead));
  GrblMachineSession& session = opened->session_;
  while (session.state() == MachineState::offline && interrupted_by() == 0) {
    opened->poll(GrblMachineSession::between_looks);
  }
  if (session.state() == MachineState::idle || session.state() == MachineState::door) {
    note_unknown_firmware(board, session.board());
    if (const auto& warning = session.match().warning) {
      note(fmt::format("{}: {} [{}]", board, warning->text, warning->code));
    }
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
  note_trouble(board_, session_.take_messages());
  const std::string_view wait = session_.sender().waits_for();
  if (std::exchange(last_wait_, wait) == wait || wait.empty()) return;
  ProgressDisplay::clear_shown();
  note(std::string(wait));
}

void GrblMachineConnection::poll_until_done() {
  // A board that is lost or in an alarm does not answer earlier requests.
  const auto waits = [&] { return session_.busy() || (session_.state() == MachineState::idle && session_.works()); };
  while (waits()) poll(GrblMachineSession::between_looks);
}

std::string GrblMachineConnection::words() const {
  const GrblMachine& board = session_.board();
  return fmt::format("{} {} on {}", board.firmware, board.version, board_);
}

bool leaves_spindle_to_grbl(const MachineDescription& machine) {
  if (!machine.spindle.modbus) return true;
  fail(exit_bad_machine,
       "[spindle.modbus] is for Passo's boards: a board with Grbl controls the spindle itself. grblHAL and FluidNC "
       "have settings for such drives [spindle.grbl]");
  return false;
}

std::string place_words(const GrblSender& sender) {
  const auto place = sender.place();
  if (!place) return "an unknown position";
  std::string words;
  AxisSet told;
  for (const char letter : sender.machine().axes) {
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

void note_trouble(const std::string& board, const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    if (!message.starts_with("ERR") && !message.starts_with("WARN")) continue;  // as FluidNC begins them
    ProgressDisplay::clear_shown();
    note(fmt::format("{}: the board says: {}", board, message));
  }
}

void note_unknown_firmware(const std::string& board, const GrblMachine& machine) {
  if (machine.is_known()) return;
  note(fmt::format("{}: Passo does not know the firmware {} {}, and treats it as Grbl 1.1", board, machine.firmware,
                   machine.version));
}

}  // namespace passo
