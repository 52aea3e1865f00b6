#include "mode_codes.hpp"

#include <algorithm>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

using enum ModalGroup;

}  // namespace

bool ModeCodes::set(const CodeEntry& entry) {
  const GroupRow& group = row_of(entry.group);
  const bool changes = state_.modal[entry.group] != entry.number;
  state_.modal.set(entry.group, entry.number);
  if (!changes && group.told == Told::when_changed) return true;
  const auto tell = [&](const OperationKind& what) { group.ahead_of_held_moves ? emit_ahead(what) : emit(what); };
  if (!entry.note.empty()) tell(operation::Comment{entry.note});
  if (entry.call != nullptr) tell(entry.call());
  return true;
}

bool ModeCodes::set_feed_mode(const CodeEntry& entry) {
  const CodeNumber number = entry.number;
  if (speaks_grbl() && number == code(94) && state_.modal[feed_mode] == number) return true;  // F is kept
  set(entry);
  if (number == code(93)) return true;
  state_.feed = 0;
  emit_feed_rate(0);
  return true;
}

bool ModeCodes::set_feed_rate() {
  if (is_negative('F')) {
    return fail("gcode.negative-word", words_.span('F'),
                interpreter_says::feed_is.with({{"value", plain_number(words_['F'])}}),
                interpreter_says::feed_from_zero);
  }
  const double units = never_negative('F');
  if (state_.modal.inverse_time()) {
    const CodeNumber mover = block_.motion == nullptr ? code(80) : block_.motion->number;
    const bool probes = speaks_grbl() && mover >= code(38, 2) && mover <= code(38, 5);
    const bool feeds = probes || (mover >= code(1) && mover <= code(5, 1));
    if (!feeds) {
      reporter_.warning(
          "gcode.unused-feed", words_.span('F'),
          "F has no effect: in inverse time mode (G93) it applies only to G1, G2, G3, G5 or G5.1 in the same block",
          "F with each feed move");
    }
    return true;  // used with the move, whose length it needs
  }
  const CodeEntry* const new_units = words_.code(length_units);
  if (new_units != nullptr && new_units->number != state_.modal[length_units]) {
    reporter_.warning("gcode.feed-before-units", words_.span('F'),
                      fmt::format("F is read in {}/min, because {} in the same block takes effect after it",
                                  state_.modal.inches() ? "inches" : "millimetres", spelling(*new_units)),
                      fmt::format("{} in an earlier block", spelling(*new_units)));
  }
  state_.feed = units * state_.length_unit();
  block_.missing_feed_told = false;
  emit_feed_rate(units);
  return true;
}

bool ModeCodes::set_path_mode(CodeNumber number) {
  const double unit = state_.length_unit();
  if (words_.has('R')) {
    reporter_.warning("gcode.unused-word", words_.span('R'),
                      "R of G64 has no effect: it is a tuning value of LinuxCNC 2.10's planner",
                      "P, which determines the speed in corners");
  }
  state_.modal.set(path_mode, number);
  if (number == code(64)) {
    // Without Q, P is also the merge tolerance. Negative values count as 0, as in LinuxCNC.
    const double path = words_.has('P') ? std::max(0.0, words_['P']) : 0;
    const double merge = words_.has('Q') ? std::max(0.0, words_['Q']) : path;
    state_.tolerance = {Mm(path * unit), Mm(merge * unit)};
  }
  emit_path_mode();
  return true;
}

void ModeCodes::emit_path_mode() {
  const CodeNumber active = state_.modal[path_mode];
  if (active == code(64)) {
    emit(operation::SetPathMode{PathMode::continuous, state_.tolerance.path});
    emit(operation::SetMergeTolerance{state_.tolerance.merge});
  } else {
    emit(operation::SetPathMode{active == code(61) ? PathMode::exact_path : PathMode::exact_stop, Mm(0)});
  }
}

void ModeCodes::restore_path_mode(CodeNumber number, const PathTolerance& tolerance) {
  state_.modal.set(path_mode, number);
  state_.tolerance = tolerance;
  emit_path_mode();
}

// A tool that turns would fly out. Only the tool change opens the collet.
bool ModeCodes::opens_collet(CodeNumber number) const {
  const ToolChangePlan* const plan = block_.options.tool_change.get();
  if (plan == nullptr || plan->way != ToolChangeWay::rack) return false;
  return number == (plan->rack.opens == ColletOutput::mist ? code(7) : code(8));
}

bool ModeCodes::switch_coolant(CodeNumber number) {
  const bool off = number == code(9);
  if (opens_collet(number)) {
    return fail(
        "gcode.collet-output", words_.span(coolant),
        fmt::format("M{} would open the collet: it is the output of [tool_change.rack]", number == code(7) ? 7 : 8),
        number == code(7) ? "no M7; M8 for coolant" : "no M8; M7 for coolant");
  }
  if (number == code(7) || off) emit(operation::SetMist{state_.mist = !off});
  if (number == code(8) || off) emit(operation::SetFlood{state_.flood = !off});
  return true;
}

// M48 and M49 switch the overrides of the feed and of all spindles. M50 to M53 switch one thing each; P0 is off.
bool ModeCodes::switch_overrides(CodeNumber number) {
  const bool on = number == code(48) || (number != code(49) && !(words_.has('P') && words_['P'] == 0));
  SpindleRange range{0, static_cast<std::uint8_t>(state_.spindle_count)};
  switch (number) {
    case code(50): emit(operation::SetFeedOverride{state_.feed_override = on}); return true;
    case code(51):
      if (!spindle_word(SpindleChoice::one, range)) return false;
      break;
    case code(52): emit(operation::SetAdaptiveFeed{state_.feed_permissions.adaptive = on}); return true;
    case code(53): emit(operation::SetFeedHold{state_.feed_permissions.hold = on}); return true;
    default: emit(operation::SetFeedOverride{state_.feed_override = on});
  }
  for (std::uint8_t i = range.first; i < range.end; ++i) {
    state_.spindles[i].speed_override = on;
    emit(operation::SetSpeedOverride{on, i});
  }
  return true;
}

}  // namespace passo
