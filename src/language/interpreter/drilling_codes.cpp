#include "drilling_codes.hpp"

#include <numbers>

#include <fmt/format.h>

#include "passo/interpreter/plane_axes.hpp"

namespace passo {
namespace {

using enum ModalGroup;

constexpr double most_repeats = 1e6;
constexpr double most_pecks = 1e5;

// The words of G87 that go along X, Y and Z.
constexpr std::pair<char, std::size_t> aside_letters[] = {{'I', 0}, {'J', 1}, {'K', 2}};

}  // namespace

bool DrillingCodes::start(CodeNumber number) {
  const PlaneAxes axes = axes_of(state_.modal.plane());
  const bool goes_on = kept_.code == number && kept_.plane == state_.modal.plane();
  // If the cycle's first block was wrong, the blocks that follow are wrong for the same reason, which was reported.
  if (goes_on && !kept_.complete && words_.code(motion) == nullptr) return false;
  const bool first = !goes_on || !kept_.complete;
  if (kept_.code == 0 || kept_.plane != state_.modal.plane()) {
    kept_.initial_height = state_.position[axes.normal];
  }
  kept_.code = number;
  kept_.plane = state_.modal.plane();
  kept_.complete = false;
  Point hole;
  std::int32_t holes = 1;
  if (!check(number, hole) || !check_words(number, first, holes)) return false;
  keep_words(first);
  DrillingPlan plan = plan_of(number, hole);
  plan.holes = holes;
  if (!check_depths(plan)) return false;
  kept_.complete = true;
  cycle_.emplace(plan, block_.source);
  return true;
}

bool DrillingCodes::check_depths(const DrillingPlan& plan) {
  if (plan.retract < plan.bottom) {
    const char letter = words_.has('R') ? 'R' : letter_of(plan.axis);
    return fail("gcode.retract-below-bottom", words_.has(letter) ? words_.span(letter) : motion_span(),
                fmt::format("R is below {}: the hole would start below its bottom", letter_of(plan.axis)),
                fmt::format("R at or above {}", letter_of(plan.axis)));
  }
  if (pecks(plan.code) && (plan.retract - plan.bottom) / plan.peck > most_pecks) {
    return fail("gcode.peck-too-small", words_.has('Q') ? words_.span('Q') : motion_span(),
                fmt::format("more than {:.0f} pecks per hole", most_pecks), "a larger Q");
  }
  return true;
}

// The checks that do not concern the cycle's own words.
bool DrillingCodes::check(CodeNumber number, Point& hole) {
  const std::string name = spelling('G', number);
  if (!check_cycle(name)) return false;
  const bool uvw = is_of_uvw(state_.modal.plane());
  for (const char letter : uvw ? std::string_view("XYZABC") : std::string_view("ABCUVW")) {
    if (!words_.has(letter)) continue;
    return fail("gcode.cycle-axis", words_.span(letter),
                fmt::format("{} does not move {}{}", name, letter, uvw ? " in a plane of U V W" : ""),
                fmt::format("{}; {} in an earlier block", uvw ? "U, V and W" : "X, Y and Z", letter));
  }
  return end_point(hole) && check_feed() && check_spindle(number);
}

bool DrillingCodes::check_spindle(CodeNumber number) {
  const SpindleDirection direction = state_.spindles[0].direction;
  const std::string name = spelling('G', number);
  if (taps(number)) {
    const bool right = number == code(84);
    if (direction == (right ? SpindleDirection::clockwise : SpindleDirection::counterclockwise)) return true;
    return fail("gcode.cycle-spindle", motion_span(),
                fmt::format("{} while the spindle {}", name,
                            direction == SpindleDirection::off ? "does not turn" : "turns in the other direction"),
                right ? "M3 before, or in this block" : "M4 before, or in this block");
  }
  if (!stops_spindle(number) || direction != SpindleDirection::off) return true;
  return fail("gcode.cycle-spindle", motion_span(), fmt::format("{} while the spindle does not turn", name),
              "M3 or M4 in this block or earlier");
}

// Checks the words of the cycle. Only the first block must give all of them; later blocks may leave them out.
bool DrillingCodes::check_words(CodeNumber number, bool first, std::int32_t& holes) {
  const std::string name = spelling('G', number);
  const char depth_letter = letter_of(axes_of(state_.modal.plane()).normal);
  const auto missing = [&](char letter, std::string_view what) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without {}", name, letter),
                fmt::format("{}, {}", letter, what));
  };
  if (first && !words_.has(depth_letter)) return missing(depth_letter, "the bottom of the hole");
  if (first && !words_.has('R')) return missing('R', "the level at which the feed starts");
  if (first && dwells(number) && !words_.has('P')) return missing('P', "the time to wait at the bottom in seconds");
  if (first && pecks(number) && !words_.has('Q')) return missing('Q', "the depth of one peck");
  for (const auto& [letter, axis] : aside_letters) {
    if (first && number == code(87) && !words_.has(letter)) {
      return missing(letter, "the sideways offset of the tool, or the start of the back bore");
    }
  }
  if (takes('P') && is_negative('P')) {
    return fail("gcode.negative-word", words_.span('P'), "a dwell of " + number_and_noun(words_['P'], "second"),
                "P of 0 or more");
  }
  if (takes('Q') && words_['Q'] <= 0) {
    return fail("gcode.negative-word", words_.span('Q'), fmt::format("a peck of {}", plain_number(words_['Q'])),
                "Q above 0");
  }
  if (takes('D') && is_negative('D')) {
    return fail("gcode.negative-word", words_.span('D'),
                fmt::format("a peck that retracts by {}", plain_number(words_['D'])), "D of 0 or more");
  }
  return !words_.has('L') || whole_word('L', 1, most_repeats, holes);
}

void DrillingCodes::keep_words(bool first) {
  const Axis depth = axes_of(kept_.plane).normal;
  const double unit = state_.length_unit();
  if (first) kept_.dwell = 0;
  if (words_.has(letter_of(depth))) kept_.depth = axis_word(depth);
  if (words_.has('R')) kept_.retract = words_['R'] * unit;
  if (takes('P')) kept_.dwell = never_negative('P');
  if (takes('Q')) kept_.peck = words_['Q'] * unit;
  const std::size_t first_axis = index_of(is_of_uvw(kept_.plane) ? Axis::u : Axis::x);
  for (const auto& [letter, axis] : aside_letters) {
    if (words_.has(letter)) kept_.aside[all_axes[first_axis + axis]] = words_[letter] * unit;
  }
}

// In incremental distances R counts from the initial height, the depth from R, and a back bore's top from the bottom.
DrillingPlan DrillingCodes::plan_of(CodeNumber number, const Point& hole) const {
  const bool incremental = state_.modal.incremental();
  const CodeNumber mode = state_.modal[path_mode];
  DrillingPlan plan{.code = number, .axis = axes_of(kept_.plane).normal, .start = state_.position, .hole = hole};
  plan.initial_height = kept_.initial_height;
  plan.returns_to_initial = state_.modal[retract] == code(98);
  plan.retract = kept_.retract + (incremental ? kept_.initial_height : 0);
  plan.bottom = kept_.depth + (incremental ? plan.retract : 0);
  plan.top = kept_.aside[plan.axis] + (incremental ? plan.bottom : 0);
  plan.aside = kept_.aside;
  plan.dwell = kept_.dwell;
  plan.peck = kept_.peck;
  if (takes('D')) plan.clearance = never_negative('D') * state_.length_unit();
  plan.spindle = state_.spindles[0].direction;
  plan.feed_override = state_.feed_override;
  plan.speed_override = state_.spindles[0].speed_override;
  plan.retracts_by_hand = !state_.on_machine;
  plan.path_mode = mode == code(64)   ? PathMode::continuous
                   : mode == code(61) ? PathMode::exact_path
                                      : PathMode::exact_stop;
  plan.tolerance = state_.tolerance;
  if (incremental) plan_way(plan);
  return plan;
}

void DrillingCodes::plan_way(DrillingPlan& plan) const {
  if ((words_.present() & polar_letters).any()) {
    plan.polar = PolarWay{.radius = words_.has('@') ? words_['@'] * state_.length_unit() : 0,
                          .angle = words_.has('^') ? words_['^'] * (std::numbers::pi / 180) : 0};
    return;
  }
  plan.way.emplace();
  for (const Axis axis : all_axes) {
    if (words_.has(letter_of(axis))) (*plan.way)[axis] = axis_word(axis);
  }
}

bool DrillingCodes::finish() {
  return !cycle_->stuck() || fail_at_origin(words_.has('@') ? '@' : '^');
}

}  // namespace passo
