#include "opened_grbl.hpp"

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

std::unique_ptr<OpenedGrbl> OpenedGrbl::open(const std::string& board, int& code) {
  const auto address = parse_board_address(board);
  if (!address) {
    code = fail(exit_bad_program, address.error());
    return nullptr;
  }
  auto claim = BoardClaim::take(*address);
  if (!claim) {
    code = fail(exit_failed, claim.error());
    return nullptr;
  }
  auto port = open_board(*address);
  if (!port) {
    code = fail(exit_failed, port.error());
    return nullptr;
  }
  std::unique_ptr<OpenedGrbl> opened(new OpenedGrbl(std::move(*claim), std::move(*port)));
  GrblSender& sender = opened->sender_;
  while (!sender.ready() && !sender.fault() && interrupted_by() == 0) opened->turn(between_looks);
  if (sender.ready()) return opened;
  code = sender.fault() ? fail(exit_failed, fmt::format("{}: {}", board, words_of(*sender.fault(), "")))
                        : 128 + interrupted_by();
  return nullptr;
}

void OpenedGrbl::turn(Seconds most) {
  const std::string bytes = sender_.take_bytes(now());
  port_->receive({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  // A line that is opened anew may reset the machine, so a line that broke stays so.
  if (port_->broken()) return sender_.lose();
  if (!port_->run(most)) return;
  const auto came = port_->replies();
  sender_.receive({reinterpret_cast<const char*>(came.data()), came.size()}, now());
}

bool OpenedGrbl::turn_to_rest(const std::function<void()>& watch) {
  while (!sender_.at_rest() || sender_.stops()) {
    if (interrupted_by() != 0) sender_.stop();
    if (sender_.stopped() || (sender_.fault() && !sender_.stops())) break;
    turn(between_looks);
    if (watch) watch();
  }
  return !sender_.fault() && !sender_.stopped();
}

bool OpenedGrbl::home(int& code) {
  sender_.add("$H", 0, longest_homing);
  if (turn_to_rest()) return true;
  code = sender_.fault() ? fail(exit_failed, words_of(*sender_.fault(), "")) : 128 + interrupted_by();
  return false;
}

std::string OpenedGrbl::place_words() const {
  const auto place = sender_.place();
  if (!place) return "a place that is not known";
  return fmt::format("X{:.3f} Y{:.3f} Z{:.3f}", (*place)[Axis::x], (*place)[Axis::y], (*place)[Axis::z]);
}

std::string words_of(const GrblFault& fault, const std::string& program) {
  std::string where;
  if (fault.last_line != 0 && !program.empty()) {
    where = fault.first_line < fault.last_line
                ? fmt::format("{}, between line {} and line {}: ", program, fault.first_line, fault.last_line)
                : fmt::format("{}:{}: ", program, fault.last_line);
  }
  return fmt::format("{}{} [{}]", where, fault.message, fault.code);
}

}  // namespace passo
