#include "executor.hpp"

#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

bool is_whole(double value) {
  return std::fabs(value - std::round(value)) < whole_number_tolerance;
}

}  // namespace

void Executor::emit(OperationKind what) {
  operations_.push_back({.what = std::move(what), .source = source_});
  state_.frame.follow(operations_.back());
}

void Executor::begin() {
  emit(operation::SetLengthUnits{state_.units});
  emit(operation::SetWorkOffset{.system = 1, .offset = {}});
  emit(operation::SetG92Offset{});
  emit(operation::SetRotation{});
  emit(operation::SetFeedReference{});
  emit(operation::Reset{});
}

bool Executor::execute(BlockWords& words, const OperationSource& source) {
  source_ = source;
  words.take('N');
  if (!check_words(words)) return false;
  if (!feed_mode(words) || !feed_rate(words) || !spindle_speed(words) || !tool(words)) return false;
  spindle(words);
  coolant(words);
  if (!dwell(words)) return false;
  plane_and_units(words);
  if (!tool_length(words)) return false;
  work_offset(words);
  if (!path_mode(words)) return false;
  distance_modes(words);
  if (!non_modal(words) || !motion(words)) return false;
  stop(words);
  if (const char letter = words.unused(); letter != 0) {
    return reporter_.error(
        "gcode.unused-word", words.span(letter), fmt::format("nothing in this block uses {}", letter),
        letter == 'E' ? "numbers without an exponent: 1e3 is 1000 in G-code" : "a code that takes it, or none");
  }
  return true;
}

// What is accepted and changes nothing has no function below: G40, G97, G98, G99, M48, M49.
bool Executor::check_words(BlockWords& words) {
  if (words.code(tool_change).is(610)) {
    const double q = words.take('Q');
    if (!words.has('Q') || q < 0 || !is_whole(q)) {
      return reporter_.error("gcode.missing-value", words.code(tool_change).span, "M61 needs a tool number",
                             "Q with a whole number from 0");
    }
  }
  return true;
}

bool Executor::feed_mode(BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::feed_mode);
  if (!code) return true;
  struct Mode {
    FeedMode mode;
    const char* comment;
  };
  const Mode mode = code.is(930) ? Mode{FeedMode::inverse_time, "interpreter: feed mode set to inverse time"}
                    : code.is(940)
                        ? Mode{FeedMode::units_per_minute, "interpreter: feed mode set to units per minute"}
                        : Mode{FeedMode::units_per_revolution, "interpreter: feed mode set to units per revolution"};
  emit(operation::Comment{mode.comment});
  // Inverse time is resolved here, move by move: below the interpreter feeds are speeds.
  const bool per_revolution = mode.mode == FeedMode::units_per_revolution;
  emit(operation::SetFeedMode{per_revolution ? FeedMode::units_per_revolution : FeedMode::units_per_minute});
  if (mode.mode != FeedMode::inverse_time) {
    state_.feed_rate = 0;
    emit(operation::SetFeedRate{0});
  }
  state_.feed_mode = mode.mode;
  return true;
}

bool Executor::feed_rate(BlockWords& words) {
  if (!words.has('F')) return true;
  if (state_.feed_mode == FeedMode::inverse_time) {
    if (words.peek('F') > 0) return true;  // its move takes it
    return reporter_.error("gcode.value-out-of-range", words.span('F'), "F is not above zero",
                           "in inverse time mode (G93) one over the minutes that the move takes");
  }
  const double rate = words.take('F');
  if (rate < 0) {
    return reporter_.error("gcode.value-out-of-range", words.span('F'), "the feed rate is negative",
                           "F with a number from 0");
  }
  const bool per_minute = state_.feed_mode == FeedMode::units_per_minute;
  state_.feed_rate = rate * state_.scale() / (per_minute ? seconds_per_minute : 1);
  emit(operation::SetFeedRate{state_.feed_rate});
  return true;
}

bool Executor::spindle_speed(BlockWords& words) {
  if (words.code(spindle_mode)) emit(operation::SetSpindleMode{});
  if (!words.has('S')) return true;
  state_.spindle_speed = words.take('S');
  if (state_.spindle_speed < 0) {
    return reporter_.error("gcode.value-out-of-range", words.span('S'), "the spindle speed is negative",
                           "S with a number from 0; M4 turns it the other way");
  }
  emit(operation::SetSpindleSpeed{state_.spindle_speed});
  return true;
}

bool Executor::tool(BlockWords& words) {
  if (words.has('T')) {
    const double tool = words.take('T');
    if (tool < 0 || tool > 1e6 || !is_whole(tool)) {
      return reporter_.error("gcode.value-out-of-range", words.span('T'), "T is no number of a tool",
                             "a whole number from 0");
    }
    state_.selected_tool = static_cast<std::int32_t>(std::lround(tool));
    emit(operation::SelectTool{state_.selected_tool});
  }
  const CodeWord& change = words.code(tool_change);
  if (change.is(60)) {
    state_.spindle = SpindleDirection::off;
    emit(operation::TurnSpindle{});
    state_.tool = state_.selected_tool;
    emit(operation::ChangeTool{state_.tool});
  } else if (change.is(610)) {
    state_.tool = static_cast<std::int32_t>(std::lround(words.take('Q')));
    emit(operation::SetToolNumber{state_.tool});
  }
  return true;
}

void Executor::spindle(const BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::spindle);
  if (!code) return;
  state_.spindle = code.is(30)   ? SpindleDirection::clockwise
                   : code.is(40) ? SpindleDirection::counterclockwise
                                 : SpindleDirection::off;
  emit(operation::TurnSpindle{state_.spindle});
}

void Executor::coolant(const BlockWords& words) {
  if (words.mist()) emit(operation::SetMist{state_.mist = true});
  if (words.flood()) emit(operation::SetFlood{state_.flood = true});
  if (!words.code(ModalGroup::coolant).is(90)) return;
  emit(operation::SetMist{state_.mist = false});
  emit(operation::SetFlood{state_.flood = false});
}

bool Executor::dwell(BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::non_modal);
  if (!code.is(40)) return true;
  if (!words.has('P')) {
    return reporter_.error("gcode.missing-value", code.span, "G4 does not say how long", "P with seconds");
  }
  const double seconds = words.take('P');
  if (seconds < 0) {
    return reporter_.error("gcode.value-out-of-range", words.span('P'), "the dwell is negative", "seconds from 0");
  }
  emit(operation::Dwell{Seconds(seconds)});
  return true;
}

void Executor::plane_and_units(const BlockWords& words) {
  if (const CodeWord& code = words.code(plane)) {
    state_.plane = static_cast<Plane>((code.code->number - 170) / 10);
    emit(operation::SelectPlane{state_.plane});
  }
  if (const CodeWord& code = words.code(units)) {
    state_.units = code.is(200) ? LengthUnits::inch : LengthUnits::mm;
    emit(operation::SetLengthUnits{state_.units});
  }
}

bool Executor::path_mode(BlockWords& words) {
  const CodeWord& code = words.code(path);
  if (!code) return true;
  state_.path_mode = code.is(610) ? PathMode::exact_path : code.is(611) ? PathMode::exact_stop : PathMode::continuous;
  if (state_.path_mode != PathMode::continuous) {
    emit(operation::SetPathMode{.mode = state_.path_mode});
    return true;
  }
  const double tolerance = length_word(words, 'P');
  const double merge = words.has('Q') ? length_word(words, 'Q') : tolerance;
  if (tolerance < 0 || merge < 0) {
    return reporter_.error("gcode.value-out-of-range", code.span, "a tolerance is negative", "P and Q from 0");
  }
  emit(operation::SetPathMode{.mode = state_.path_mode, .tolerance = Mm(tolerance)});
  emit(operation::SetMergeTolerance{Mm(merge)});
  return true;
}

void Executor::distance_modes(const BlockWords& words) {
  if (const CodeWord& code = words.code(diameter)) state_.diameters = code.is(70);
  if (const CodeWord& code = words.code(distance)) state_.incremental = code.is(910);
  if (const CodeWord& code = words.code(arc_distance)) state_.arc_centers_absolute = code.is(901);
}

void Executor::stop(const BlockWords& words) {
  const CodeWord& code = words.code(stopping);
  if (!code) return;
  if (code.is(10)) {
    emit(operation::OptionalProgramStop{});
  } else if (code.is(20) || code.is(300)) {
    end_program();
  } else {
    emit(operation::ProgramStop{});
  }
}

// M2 and M30 put the modes back (NIST RS274/NGC 3.6.1).
void Executor::end_program() {
  change_frame([this] {
    state_.work_system = 0;
    emit_work_offset();
  });
  state_.plane = Plane::xy;
  state_.incremental = false;
  state_.feed_mode = FeedMode::units_per_minute;
  state_.feed_rate = 0;
  state_.motion.reset();
  state_.spindle = SpindleDirection::off;
  emit(operation::SetFeedMode{});
  emit(operation::SetFeedRate{0});
  emit(operation::TurnSpindle{});
  emit(operation::SetSpindleMode{});
  if (state_.mist) emit(operation::SetMist{state_.mist = false});
  if (state_.flood) emit(operation::SetFlood{state_.flood = false});
  emit(operation::ProgramEnd{});
  ended_ = true;
}

}  // namespace passo
