// BlockExecutor: drilling, tapping and boring cycles (G73, G74, G81 … G89).
//
// The moves are those of RS274/NGC (NIST 6556, 3.5.16) in the order in which LinuxCNC makes them. A hole or a peck at a
// time, so that any number of holes fits the queue.
#include <algorithm>
#include <cmath>

#include "block_executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double peck_clearance = 0.254;  // mm above the bottom so far: a hundredth of an inch, as in LinuxCNC
constexpr double at_bottom = 1e-7;        // mm: a peck that ends there is the last one
constexpr double most_repeats = 1e6;
constexpr double most_pecks = 1e5;

constexpr bool pecks(CodeNumber number) {
  return number == code(73) || number == code(83);
}
constexpr bool taps(CodeNumber number) {
  return number == code(74) || number == code(84);
}
constexpr bool needs_dwell(CodeNumber number) {
  return number == code(82) || number == code(86) || number == code(88) || number == code(89);
}
constexpr bool needs_spindle(CodeNumber number) {
  return number == code(86) || number == code(87) || number == code(88);
}
// The words of G87 that go along X, Y and Z.
constexpr std::pair<char, std::size_t> aside_letters[] = {{'I', 0}, {'J', 1}, {'K', 2}};

}  // namespace

bool BlockExecutor::start_drilling(CodeNumber number) {
  const PlaneAxes axes = axes_of(state_.modal.plane());
  const bool goes_on = drilling_words_.code == number && drilling_words_.plane == state_.modal.plane();
  // After a first block that was wrong all that follow it are, for the same reason.
  if (goes_on && !drilling_words_.complete && words_.code(motion) == nullptr) return false;
  const bool first = !goes_on || !drilling_words_.complete;
  if (drilling_words_.code == 0 || drilling_words_.plane != state_.modal.plane()) {
    drilling_words_.initial_height = state_.position[axes.normal];
  }
  drilling_words_.code = number;
  drilling_words_.plane = state_.modal.plane();
  drilling_words_.complete = false;
  if (!check_drilling(number) || !check_drilling_words(number, first)) return false;
  prepare_drilling(number);
  if (drilling_.retract < drilling_.bottom) {
    const char letter = words_.has('R') ? 'R' : letter_of(axes.normal);
    return fail("gcode.retract-below-bottom", words_.has(letter) ? words_.span(letter) : motion_span(),
                fmt::format("R is below {}: the hole begins under its bottom", letter_of(axes.normal)),
                fmt::format("R at or above {}", letter_of(axes.normal)));
  }
  if (pecks(number) && (drilling_.retract - drilling_.bottom) / drilling_words_.peck > most_pecks) {
    return fail("gcode.peck-too-small", words_.has('Q') ? words_.span('Q') : motion_span(),
                fmt::format("more than {:.0f} pecks a hole", most_pecks), "a larger Q");
  }
  drilling_words_.complete = true;

  Point& position = state_.position;
  if (drilling_words_.initial_height < drilling_.retract) {
    move_along(axes.normal, drilling_.retract, true);
  }
  const bool old_height = state_.modal[retract] == code(98);
  const double between = old_height ? drilling_words_.initial_height : drilling_.retract;
  drilling_.height = std::max(position[axes.normal], between);
  drilling_.clear = std::max(drilling_.retract, between);
  if (state_.modal[path_mode] != code(61)) emit(operation::SetPathMode{PathMode::exact_path, Mm(0)});
  cycle_ = Cycle::drilling;
  return true;
}

// What has nothing to do with this cycle's own words.
bool BlockExecutor::check_drilling(CodeNumber number) {
  const std::string name = spelling('G', number);
  if (!check_cycle(name)) return false;
  const bool uvw = is_of_uvw(state_.modal.plane());
  for (const char letter : uvw ? std::string_view("XYZABC") : std::string_view("ABCUVW")) {
    if (!words_.has(letter)) continue;
    return fail("gcode.cycle-axis", words_.span(letter),
                fmt::format("{} does not move {}{}", name, letter, uvw ? " in a plane of U V W" : ""),
                fmt::format("{}; {} in a block before", uvw ? "U, V and W" : "X, Y and Z", letter));
  }
  Point hole;
  return end_point(hole) && check_feed() && check_drilling_spindle(number);
}

bool BlockExecutor::check_drilling_spindle(CodeNumber number) {
  const SpindleDirection direction = state_.spindles[0].direction;
  const std::string name = spelling('G', number);
  if (taps(number)) {
    const bool right = number == code(84);
    if (direction == (right ? SpindleDirection::clockwise : SpindleDirection::counterclockwise)) return true;
    return fail("gcode.cycle-spindle", motion_span(),
                fmt::format("{} while the spindle {}", name,
                            direction == SpindleDirection::off ? "does not turn" : "turns the other way"),
                right ? "M3 before, or in this block" : "M4 before, or in this block");
  }
  if (!needs_spindle(number) || direction != SpindleDirection::off) return true;
  return fail("gcode.cycle-spindle", motion_span(), fmt::format("{} while the spindle does not turn", name),
              "M3 or M4 before, or in this block");
}

// R, the depth, L, P and Q: given, or left over from the block before.
bool BlockExecutor::check_drilling_words(CodeNumber number, bool first) {
  const std::string name = spelling('G', number);
  const char depth_letter = letter_of(axes_of(state_.modal.plane()).normal);
  const auto missing = [&](char letter, std::string_view what) {
    return fail("gcode.missing-word", motion_span(), fmt::format("{} without {}", name, letter),
                fmt::format("{}, {}", letter, what));
  };
  if (first && !words_.has(depth_letter)) return missing(depth_letter, "the bottom of the hole");
  if (first && !words_.has('R')) return missing('R', "where the feed begins");
  if (first && needs_dwell(number) && !words_.has('P')) return missing('P', "the seconds to wait at the bottom");
  if (first && pecks(number) && !words_.has('Q')) return missing('Q', "the depth of one peck");
  for (const auto& [letter, axis] : aside_letters) {
    if (first && number == code(87) && !words_.has(letter)) {
      return missing(letter, "how far the tool goes aside, or where the back bore begins");
    }
  }
  if (words_.has('P') && words_['P'] < 0) {
    return fail("gcode.negative-word", words_.span('P'),
                fmt::format("a dwell of {} seconds", plain_number(words_['P'])), "P of 0 or more");
  }
  if (words_.has('Q') && words_['Q'] <= 0) {
    return fail("gcode.negative-word", words_.span('Q'), fmt::format("a peck of {}", plain_number(words_['Q'])),
                "Q above 0");
  }
  drilling_.holes_left = 1;
  if (words_.has('L') && !whole_word('L', 1, most_repeats, drilling_.holes_left)) return false;

  DrillingWords& kept = drilling_words_;
  if (first) kept.dwell = 0;
  if (words_.has(depth_letter)) kept.depth = axis_word(axes_of(state_.modal.plane()).normal);
  if (words_.has('R')) kept.retract = words_['R'] * state_.length_unit();
  if (words_.has('P')) kept.dwell = words_['P'];
  if (words_.has('Q')) kept.peck = words_['Q'] * state_.length_unit();
  const std::size_t first_axis = index_of(is_of_uvw(kept.plane) ? Axis::u : Axis::x);
  for (const auto& [letter, axis] : aside_letters) {
    if (words_.has(letter)) kept.aside[all_axes[first_axis + axis]] = words_[letter] * state_.length_unit();
  }
  return true;
}

// In incremental distances R counts from where the cycle began, and the depth from R.
void BlockExecutor::prepare_drilling(CodeNumber number) {
  const bool incremental = state_.modal.incremental();
  drilling_.code = number;
  drilling_.axis = axes_of(state_.modal.plane()).normal;
  drilling_.in_hole = false;
  drilling_.retract = drilling_words_.retract + (incremental ? drilling_words_.initial_height : 0);
  drilling_.bottom = drilling_words_.depth + (incremental ? drilling_.retract : 0);
  drilling_.top = drilling_words_.aside[drilling_.axis] + (incremental ? drilling_.bottom : 0);
}

void BlockExecutor::move_along(Axis axis, double height, bool rapid) {
  state_.position[axis] = height;
  if (rapid) {
    emit(operation::StraightTraverse{state_.position});
  } else {
    emit(operation::StraightFeed{state_.position});
  }
}

bool BlockExecutor::step_drilling() {
  if (!drilling_.in_hole && !go_to_hole()) return false;
  if (pecks(drilling_.code) && peck()) return true;
  finish_hole();
  drilling_.in_hole = false;
  if (--drilling_.holes_left > 0) return true;
  if (state_.modal[path_mode] != code(61)) {
    emit_path_mode();
    // LinuxCNC tells both in any mode.
    if (state_.modal[path_mode] != code(64)) emit(operation::SetMergeTolerance{state_.tolerance.merge});
  }
  cycle_ = Cycle::none;
  return true;
}

bool BlockExecutor::go_to_hole() {
  Point hole;
  if (!end_point(hole)) return false;
  hole[drilling_.axis] = drilling_.height;
  state_.position = hole;
  emit(operation::StraightTraverse{hole});
  if (drilling_.height > drilling_.retract) move_along(drilling_.axis, drilling_.retract, true);
  drilling_.height = drilling_.clear;
  drilling_.reached = drilling_.retract;
  drilling_.in_hole = true;
  return true;
}

// False where what is left is the last peck.
bool BlockExecutor::peck() {
  drilling_.reached -= drilling_words_.peck;
  if (drilling_.reached <= drilling_.bottom + at_bottom) return false;
  const Axis axis = drilling_.axis;
  move_along(axis, drilling_.reached, false);
  if (drilling_.code == code(83)) move_along(axis, drilling_.retract, true);
  move_along(axis, drilling_.reached + peck_clearance, true);
  return true;
}

void BlockExecutor::finish_hole() {
  const CodeNumber number = drilling_.code;
  if (taps(number)) return tap();
  if (number == code(87)) return bore_back();
  move_along(drilling_.axis, drilling_.bottom, false);
  if (needs_dwell(number)) emit(operation::Dwell{Seconds(drilling_words_.dwell)});
  if (needs_spindle(number)) emit(operation::TurnSpindle{});
  if (number == code(88)) emit(operation::ProgramStop{});
  if (number == code(85)) move_along(drilling_.axis, drilling_.retract, false);
  if (number == code(88) && !state_.on_machine) {
    state_.position[drilling_.axis] = drilling_.clear;  // taken out by hand
  } else {
    move_along(drilling_.axis, drilling_.clear, number != code(89));
  }
  if (needs_spindle(number)) emit(operation::TurnSpindle{state_.spindles[0].direction});
}

// With the spindle held at an angle the tool goes aside, through the hole and under it, and bores upwards there.
void BlockExecutor::bore_back() {
  const Axis axis = drilling_.axis;
  Point aside = drilling_words_.aside;
  aside[axis] = 0;
  const SpindleDirection direction = state_.spindles[0].direction;
  const auto traverse_by = [&](const Point& step) {
    state_.position = state_.position + step;
    emit(operation::StraightTraverse{state_.position});
  };
  // LinuxCNC hands the number of the direction on, where M19 has its P.
  const auto way = static_cast<operation::OrientSpindle::Way>(static_cast<int>(direction) + 1);
  const auto hold_spindle = [&] {
    emit(operation::TurnSpindle{});
    emit(operation::OrientSpindle{0, way});
  };
  traverse_by(aside);
  hold_spindle();
  move_along(axis, drilling_.bottom, true);
  traverse_by(Point{} - aside);
  emit(operation::TurnSpindle{direction});
  move_along(axis, drilling_.top, false);
  move_along(axis, drilling_.bottom, false);
  hold_spindle();
  traverse_by(aside);
  move_along(axis, drilling_.clear, true);
  traverse_by(Point{} - aside);
  emit(operation::TurnSpindle{direction});
}

// With a floating holder: the feed follows from F, in and out, and nobody may change it meanwhile.
void BlockExecutor::tap() {
  const SpindleDirection in = state_.spindles[0].direction;
  const SpindleDirection out =
      in == SpindleDirection::clockwise ? SpindleDirection::counterclockwise : SpindleDirection::clockwise;
  emit(operation::SetFeedOverride{false});
  emit(operation::SetSpeedOverride{false});
  move_along(drilling_.axis, drilling_.bottom, false);
  emit(operation::TurnSpindle{});
  emit(operation::TurnSpindle{out});
  emit(operation::Dwell{Seconds(drilling_words_.dwell)});
  move_along(drilling_.axis, drilling_.clear, false);
  emit(operation::TurnSpindle{});
  emit(operation::TurnSpindle{in});
  if (state_.feed_override) emit(operation::SetFeedOverride{true});
  if (state_.spindles[0].speed_override) emit(operation::SetSpeedOverride{true});
}

}  // namespace passo
