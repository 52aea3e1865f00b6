#include "grbl_connection.hpp"

#include <utility>

#include "commands.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// Grbl tells nothing while it homes.
constexpr Seconds longest_homing{300};

}  // namespace

bool names_grbl_machine(const std::string& board) {
  return board.starts_with("grbl:");
}

std::unique_ptr<GrblConnection> GrblConnection::open(const std::string& board, int& code) {
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
  std::unique_ptr<GrblConnection> opened(new GrblConnection(board, std::move(*claim), std::move(*port)));
  if (!opened->greet(code)) return nullptr;
  const GrblMachine& machine = opened->sender_.machine();
  if (!machine.is_known())
    note(fmt::format("{}: Passo does not know the firmware {} {}, and treats it as Grbl 1.1", board, machine.firmware,
                     machine.version));
  return opened;
}

bool GrblConnection::greet(int& code) {
  while (!sender_.ready() && !sender_.fault() && interrupted_by() == 0) poll(between_looks);
  if (sender_.ready()) return true;
  code = give_up();
  return false;
}

// The sender is silent meanwhile, and asks the board again afterwards.
bool GrblConnection::upload(FileUpload upload, int& code) {
  bool ended = false;
  while (!ended) {
    if (interrupted_by() != 0) upload.cancel();
    const std::string bytes = upload.take_bytes(now());
    port_->receive({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    ended = upload.ended();
    if (port_->broken()) {
      code = fail(exit_failed, board_ + ": the connection is lost [grbl.line-lost]");
      return false;
    }
    if (!port_->run(between_looks)) continue;
    const auto came = port_->replies();
    upload.receive({reinterpret_cast<const char*>(came.data()), came.size()}, now());
  }
  if (!upload.trouble().empty()) {
    code = interrupted_by() != 0 ? exit_of_signal()
                                 : fail(exit_failed, fmt::format("{}: {} [board.upload]", board_, upload.trouble()));
    return false;
  }
  sender_ = GrblSender::on_open_line(now());
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
  const std::string bytes = sender_.take_bytes(now());
  port_->receive({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  // A line that is opened anew may reset the machine, so a line that broke stays so.
  if (port_->broken()) return sender_.lose();
  if (!port_->run(most)) return;
  const auto came = port_->replies();
  sender_.receive({reinterpret_cast<const char*>(came.data()), came.size()}, now());
  for (const std::string& message : sender_.take_messages()) {
    const bool is_trouble = message.starts_with("ERR") || message.starts_with("WARN");  // of FluidNC
    if (is_trouble) note(fmt::format("{}: the board says: {}", board_, message));
  }
}

bool GrblConnection::poll_until_rest(const std::function<void()>& watch) {
  while (!sender_.at_rest() || sender_.stops()) {
    if (interrupted_by() != 0) sender_.stop();
    if (sender_.stopped() || (sender_.fault() && !sender_.stops())) break;
    poll(between_looks);
    if (const std::string_view wait = news_of_wait(); !wait.empty()) note(std::string(wait));
    if (watch) watch();
  }
  return !sender_.fault() && !sender_.stopped();
}

std::string_view GrblConnection::news_of_wait() {
  const std::string_view wait = sender_.waits_for();
  return std::exchange(last_wait_, wait) == wait ? std::string_view() : wait;
}

bool GrblConnection::home(int& code, std::optional<Axis> axis) {
  if (axis && !sender_.machine().homes_single_axes()) {
    code = fail(exit_failed, board_ + ": this board homes all its axes together [home.single-axis]");
    return false;
  }
  sender_.add(axis ? fmt::format("$H{}", letter_of(*axis)) : "$H", 0, longest_homing);
  // Homing may move the zero of the work: startup lines ($N0) run after it.
  const bool homed = poll_until_rest();
  if (homed) sender_.ask_for_offsets();
  if (homed && poll_until_rest()) return true;
  code = give_up();
  return false;
}

std::string GrblConnection::place_words() const {
  const auto place = sender_.place();
  if (!place) return "an unknown position";
  std::string words;
  AxisSet told;
  for (const char letter : sender_.machine().axes) {
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

}  // namespace passo
