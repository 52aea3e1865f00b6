#include "passo/sender/grbl_match.hpp"

#include <cmath>
#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr int soft_limits = 20;
constexpr int homing_cycle = 22;
constexpr int homing_directions = 23;
constexpr int steps_per_unit = 100;
constexpr int highest_rate = 110;
constexpr int travel_length = 130;
// Settings have three decimals.
constexpr double same_value = 0.01;
constexpr double same_share = 1e-4;

struct Travel {
  double low = 0;
  double high = 0;
};

// The settings of one board.
class BoardNumbers {
 public:
  explicit BoardNumbers(const GrblMachine& board) : board_(board) {}

  std::optional<double> value(int number) const {
    const auto found = board_.settings.find(number);
    return found == board_.settings.end() ? std::nullopt : std::optional(found->second);
  }
  unsigned bits(int number) const {
    const double sum = value(number).value_or(0);
    return sum >= 0 && sum < 65536 ? static_cast<unsigned>(sum) : 0;
  }
  bool homes() const { return (bits(homing_cycle) & 1U) != 0; }
  bool homes_low(int index) const { return (bits(homing_directions) >> index & 1U) != 0; }
  // Grbl and its descendants keep the zero at the high end. The others have it elsewhere, and do not tell where.
  bool tells_zero() const {
    const std::string_view name = board_.row().name;
    return homes() && (name == "grblHAL" || name.starts_with("Grbl") || name.starts_with("grbl-"));
  }
  // An axis that homes to its low end has its zero there, if the board was built or set so.
  bool sets_zero_at_switch() const {
    constexpr unsigned sets_origin = 8;
    const bool is_set = board_.row().name == "grblHAL" && (bits(homing_cycle) & sets_origin) != 0;
    return is_set || (board_.row().name != "grblHAL" && board_.options.find('Z') != std::string::npos);
  }
  // Empty: it is not told. Without homing the zero is where the machine was switched on.
  std::optional<Travel> travel(int index) const {
    const double length = std::abs(value(travel_length + index).value_or(0));
    if (!(length > 0)) return {};
    if (!tells_zero()) return Travel{.low = -length, .high = length};
    if (homes_low(index) && sets_zero_at_switch()) return Travel{.low = 0, .high = length};
    return Travel{.low = -length, .high = 0};
  }
  bool has_soft_limits() const { return tells_zero() && value(soft_limits).value_or(0) != 0; }

 private:
  const GrblMachine& board_;
};

bool is_same(double a, double b) {
  return std::abs(a - b) <= same_value + same_share * std::abs(b);
}

class Comparison {
 public:
  Comparison(const MachineDescription& machine, const GrblMachine& board)
      : machine_(machine), board_(board), settings_(board) {}

  GrblMatch match() {
    for (const AxisDescription& axis : machine_.axes) {
      const std::size_t index = board_.axes.find(letter_of(axis.axis));
      if (index != std::string::npos) compare(axis, static_cast<int>(index));
    }
    compare_kinematics();
    GrblMatch match;
    if (!differences_.empty()) match.warning = sentence("grbl.other-machine", differences_);
    if (!outside_.empty() && settings_.has_soft_limits()) match.objection = sentence("grbl.outside-travel", outside_);
    return match;
  }

 private:
  void compare_kinematics() {
    const bool tells = board_.row().tells_core_xy || !board_.kinematics.empty();
    if (!tells || board_.is_core_xy() == machine_.is_core_xy) return;
    add(differences_, machine_.is_core_xy
                          ? "the file has kinematics = \"corexy\" and the board is not built for a CoreXY"
                          : "the board is built for a CoreXY and the file has no kinematics = \"corexy\"");
  }
  void compare(const AxisDescription& axis, int index) {
    const char letter = letter_of(axis.axis);
    const auto steps = settings_.value(steps_per_unit + index);
    if (steps && *steps > 0 && std::abs(*steps - axis.steps_per_unit) > 1e-3 + same_share * *steps) {
      add(differences_,
          fmt::format("{} has {:g} steps per {} in the file and ${}={:g} on the board", letter, axis.steps_per_unit,
                      is_rotary(axis.axis) ? "degree" : "mm", steps_per_unit + index, *steps));
    }
    const auto rate = settings_.value(highest_rate + index);
    const double wanted = axis.velocity.value() * 60;
    if (rate && *rate > 0 && wanted > *rate && !is_same(wanted, *rate)) {
      add(differences_, fmt::format("{} moves at up to {:g} {}/min in the file and ${}={:g} on the board", letter,
                                    wanted, is_rotary(axis.axis) ? "deg" : "mm", highest_rate + index, *rate));
    }
    if (settings_.tells_zero() && axis.home && axis.home->toward_high == settings_.homes_low(index)) {
      const auto end = [](bool is_high) { return is_high ? "high" : "low"; };
      add(differences_,
          fmt::format("{} homes to its {} end in the file and to its {} end on the board ($23={})", letter,
                      end(axis.home->toward_high), end(!axis.home->toward_high), settings_.bits(homing_directions)));
    }
    compare_travel(axis, index);
  }
  void compare_travel(const AxisDescription& axis, int index) {
    const auto travel = settings_.travel(index);
    if (!travel) return;
    const bool leaves = axis.travel_low < travel->low - same_value || axis.travel_high > travel->high + same_value;
    if (!leaves) return;
    const std::string words = fmt::format(
        "{} goes from {:g} to {:g} in the file and from {:g} to {:g} on the board (${})", letter_of(axis.axis),
        axis.travel_low, axis.travel_high, travel->low, travel->high, travel_length + index);
    add(differences_, words);
    if (axis.travel_low > travel->high - same_value || axis.travel_high < travel->low + same_value)
      add(outside_, words);
  }
  static void add(std::string& all, const std::string& words) { all += (all.empty() ? "" : ", ") + words; }
  static Sentence sentence(const char* code, const std::string& differences) {
    constexpr std::string_view warning =
        "the machine file does not suit the board: {differences}. `passo machine --from` makes a file from the board";
    constexpr std::string_view objection =
        "the travel in the machine file lies outside that of the board, whose soft limits are on ($20=1): "
        "{differences}. "
        "`passo machine --from` makes a file from the board";
    SentenceArguments arguments = {{"differences", differences}};
    const bool is_warning = std::string_view(code) == "grbl.other-machine";
    std::string text = filled(is_warning ? warning : objection, arguments);
    return {.code = code, .arguments = std::move(arguments), .text = std::move(text)};
  }

  const MachineDescription& machine_;
  const GrblMachine& board_;
  BoardNumbers settings_;
  std::string differences_;
  std::string outside_;
};

}  // namespace

GrblMatch match_with_board(const MachineDescription& machine, const GrblMachine& board) {
  return Comparison(machine, board).match();
}

}  // namespace passo
