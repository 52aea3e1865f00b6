#include "spindle_codes.hpp"

#include <cmath>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double no_limit = 1e30;  // for G96 without D, as LinuxCNC prints it
constexpr double full_turn = 360;

}  // namespace

bool SpindleCodes::set_mode(CodeNumber number) {
  SpindleRange range;
  if (!spindle_word(SpindleChoice::one, range)) return false;
  double limit = 0;
  if (number == code(96)) {
    if (!words_.has('S')) {
      return fail("gcode.missing-word", words_.span(spindle_mode), "G96 without S",
                  "S, the surface speed in m/min, or in ft/min with G20");
    }
    limit = words_.has('D') ? words_['D'] : no_limit;
    if (limit <= 0) {
      return fail("gcode.negative-word", words_.span('D'),
                  fmt::format("D, the highest spindle speed, is {}", plain_number(limit)), "D above 0");
    }
  }
  if (range.first == 0) state_.modal.set(spindle_mode, number);
  state_.spindles[range.first].surface_limit = limit;
  emit(operation::SetSpindleMode{limit, range.first});
  return true;
}

bool SpindleCodes::set_speed() {
  SpindleRange range;
  if (!spindle_word(SpindleChoice::one_or_all, range)) return false;
  if (is_negative('S')) {
    return fail("gcode.negative-word", words_.span('S'),
                interpreter_says::speed_is.with({{"value", plain_number(words_['S'])}}),
                "S of 0 or more; M4 reverses the direction");
  }
  for (std::uint8_t i = range.first; i < range.end; ++i) {
    state_.spindles[i].speed = never_negative('S');
    emit(operation::SetSpindleSpeed{state_.spindles[i].speed, i});
  }
  return true;
}

bool SpindleCodes::turn(CodeNumber number) {
  SpindleRange range;
  if (!spindle_word(SpindleChoice::one_or_all, range)) return false;
  const SpindleDirection direction = number == code(3)   ? SpindleDirection::clockwise
                                     : number == code(4) ? SpindleDirection::counterclockwise
                                                         : SpindleDirection::off;
  for (std::uint8_t i = range.first; i < range.end; ++i) {
    state_.spindles[i].direction = direction;
    emit(operation::TurnSpindle{direction, i});
  }
  return true;
}

void SpindleCodes::stop() {
  for (std::uint8_t i = 0; i < state_.spindle_count; ++i) {
    state_.spindles[i].direction = SpindleDirection::off;
    emit(operation::TurnSpindle{SpindleDirection::off, i});
  }
}

// M19 turns the spindle only with R or P. Q makes M19 wait, also without R and P.
bool SpindleCodes::orient() {
  using Way = operation::OrientSpindle::Way;
  SpindleRange range;
  if (!spindle_word(SpindleChoice::one, range)) return false;
  const double angle = words_.has('R') ? words_['R'] : 0;
  if (angle < 0 || angle > full_turn) {
    return fail("gcode.bad-angle", words_.span('R'), fmt::format("the angle is {}", plain_number(angle)),
                "R of 0 to 360 degrees");
  }
  std::int32_t way = 0;
  if (words_.has('P') && !whole_word('P', 0, 2, way)) return false;
  if (words_.has('Q') && words_['Q'] <= 0) {
    return fail("gcode.negative-word", words_.span('Q'), "M19 waits " + number_and_noun(words_['Q'], "second"),
                "Q above 0, or no Q for no wait");
  }
  state_.spindles[range.first].direction = SpindleDirection::off;
  const bool turns = words_.has('R') || words_.has('P');
  if (turns) emit(operation::OrientSpindle{angle + block_.options.orient_offset, static_cast<Way>(way), range.first});
  if (words_.has('Q')) emit(operation::AwaitSpindle{Seconds(words_['Q']), range.first});
  return true;
}

}  // namespace passo
