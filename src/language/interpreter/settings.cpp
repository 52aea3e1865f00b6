// BlockExecutor: the codes and words that set something, switch something or stop.
#include <algorithm>

#include "block_executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

}  // namespace

bool BlockExecutor::set_feed_mode(CodeNumber number) {
  if (speaks_grbl() && number == code(94) && state_.modal[feed_mode] == number) return true;  // F is kept
  state_.modal.set(feed_mode, number);
  if (number == code(93)) {
    note("interpreter: feed mode set to inverse time");
    emit(operation::SetFeedMode{FeedMode::units_per_minute});
    return true;
  }
  const bool per_minute = number == code(94);
  note(per_minute ? "interpreter: feed mode set to units per minute"
                  : "interpreter: feed mode set to units per revolution");
  emit(operation::SetFeedMode{per_minute ? FeedMode::units_per_minute : FeedMode::units_per_revolution});
  state_.feed = 0;
  emit_feed_rate(0);
  return true;
}

bool BlockExecutor::set_feed_rate() {
  if (is_negative('F')) {
    return fail("gcode.negative-word", words_.span('F'), fmt::format("the feed rate is {}", plain_number(words_['F'])),
                "F of 0 or more");
  }
  const double units = never_negative('F');
  if (state_.modal.inverse_time()) {
    const CodeNumber mover = block_.motion == nullptr ? code(80) : block_.motion->number;
    const bool probes = speaks_grbl() && mover >= code(38, 2) && mover <= code(38, 5);
    const bool feeds = probes || (mover >= code(1) && mover <= code(5, 1));
    if (!feeds) {
      reporter_.warning(
          "gcode.unused-feed", words_.span('F'),
          "F has no effect: in inverse time (G93) it counts for the G1, G2, G3, G5 or G5.1 of its own block",
          "F with each feed move");
    }
    return true;  // used with the move, whose length it needs
  }
  const CodeEntry* const new_units = words_.code(length_units);
  if (new_units != nullptr && new_units->number != state_.modal[length_units]) {
    reporter_.warning("gcode.feed-before-units", words_.span('F'),
                      fmt::format("F is taken in {} a minute: {} of the same block comes after it",
                                  state_.modal.inches() ? "inches" : "millimetres", spelling(*new_units)),
                      fmt::format("{} in a block before", spelling(*new_units)));
  }
  state_.feed = units * state_.length_unit();
  block_.missing_feed_told = false;
  emit_feed_rate(units);
  return true;
}

// M3, M4, M5, M19 share a modal group with M70 to M73.
bool BlockExecutor::run_spindle_group(CodeNumber number) {
  switch (number) {
    case code(19): return spindles_.orient();
    case code(70):
    case code(71):
    case code(72):
    case code(73): return keep_modal_state(number);
    default: return spindles_.turn(number);
  }
}

bool BlockExecutor::switch_coolant(CodeNumber number) {
  const bool off = number == code(9);
  if (number == code(7) || off) emit(operation::SetMist{state_.mist = !off});
  if (number == code(8) || off) emit(operation::SetFlood{state_.flood = !off});
  return true;
}

// M48 and M49 switch the overrides of the feed and of all spindles. M50 to M53 switch one thing each; P0 is off.
bool BlockExecutor::switch_overrides(CodeNumber number) {
  const bool on = number == code(48) || (number != code(49) && !(words_.has('P') && words_['P'] == 0));
  SpindleRange range{0, static_cast<std::uint8_t>(state_.spindle_count)};
  switch (number) {
    case code(50): emit(operation::SetFeedOverride{state_.feed_override = on}); return true;
    case code(51):
      if (!spindle_word(SpindleChoice::one, range)) return false;
      break;
    case code(52): emit(operation::SetAdaptiveFeed{state_.adaptive_feed = on}); return true;
    case code(53): emit(operation::SetFeedHold{state_.feed_hold = on}); return true;
    default: emit(operation::SetFeedOverride{state_.feed_override = on});
  }
  for (std::uint8_t i = range.first; i < range.end; ++i) {
    state_.spindles[i].speed_override = on;
    emit(operation::SetSpeedOverride{on, i});
  }
  return true;
}

bool BlockExecutor::dwell(CodeNumber number) {
  if (number != code(4)) return true;
  if (block_.motion != nullptr && letters_of(*block_.motion).has('P')) {
    return fail("gcode.ambiguous-word", words_.span('P'),
                fmt::format("P belongs to G4 or to {}, which both use it", spelling(*block_.motion)), "two blocks");
  }
  if (is_negative('P')) {
    return fail("gcode.negative-word", words_.span('P'), "a dwell of " + number_and_noun(words_['P'], "second"),
                "P of 0 or more");
  }
  emit(operation::Dwell{Seconds(never_negative('P'))});
  return true;
}

bool BlockExecutor::select_plane(CodeNumber number) {
  state_.modal.set(plane, number);
  emit_ahead(operation::SelectPlane{state_.modal.plane()});
  return true;
}

bool BlockExecutor::set_units_before_feed(CodeNumber number) {
  return !speaks_grbl() || set_length_units(number);
}

bool BlockExecutor::set_units_after_feed(CodeNumber number) {
  return speaks_grbl() || set_length_units(number);
}

bool BlockExecutor::set_length_units(CodeNumber number) {
  state_.modal.set(length_units, number);
  emit_ahead(operation::SetLengthUnits{state_.modal.inches() ? LengthUnits::inch : LengthUnits::mm});
  return true;
}

bool BlockExecutor::set_lathe_diameter(CodeNumber number) {
  if (state_.modal[lathe_diameter] == number) return true;
  state_.modal.set(lathe_diameter, number);
  emit_ahead(operation::Comment{number == code(7) ? "interpreter: Lathe diameter mode changed to diameter"
                                                  : "interpreter: Lathe diameter mode changed to radius"});
  return true;
}

bool BlockExecutor::set_path_mode(CodeNumber number) {
  const double unit = state_.length_unit();
  if (words_.has('R')) {
    reporter_.warning("gcode.unused-word", words_.span('R'),
                      "R of G64 has no effect: it tunes the corners of LinuxCNC 2.10's own planner",
                      "P, from which the speed in corners follows");
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

void BlockExecutor::emit_path_mode() {
  const CodeNumber active = state_.modal[path_mode];
  if (active == code(64)) {
    emit(operation::SetPathMode{PathMode::continuous, state_.tolerance.path});
    emit(operation::SetMergeTolerance{state_.tolerance.merge});
  } else {
    emit(operation::SetPathMode{active == code(61) ? PathMode::exact_path : PathMode::exact_stop, Mm(0)});
  }
}

bool BlockExecutor::set_distance_mode(CodeNumber number) {
  if (state_.modal[distance] == number) return true;
  state_.modal.set(distance, number);
  note(number == code(90) ? "interpreter: distance mode changed to absolute"
                          : "interpreter: distance mode changed to incremental");
  return true;
}

bool BlockExecutor::set_arc_distance_mode(CodeNumber number) {
  if (state_.modal[arc_distance] == number) return true;
  state_.modal.set(arc_distance, number);
  note(number == code(90, 1) ? "interpreter: IJK distance mode changed to absolute"
                             : "interpreter: IJK distance mode changed to incremental");
  return true;
}

bool BlockExecutor::set_retract_mode(CodeNumber number) {
  state_.modal.set(retract, number);
  note(number == code(98) ? "interpreter: retract mode set to old_z" : "interpreter: retract mode set to r_plane");
  return true;
}

// In grbl a G53 without axis words needs no motion in its block.
bool BlockExecutor::moves_straight() const {
  if (block_.motion == nullptr && !speaks_grbl()) return false;
  const CodeNumber number = block_.motion != nullptr ? block_.motion->number : state_.modal[motion];
  return number == code(0) || number == code(1);
}

bool BlockExecutor::run_non_modal(CodeNumber number) {
  switch (number) {
    case code(10): return set_table();
    case code(28): return splines_.interrupt(), frame_.go_home(first_home_parameter);
    case code(28, 1): return frame_.store_home(first_home_parameter);
    case code(30): return splines_.interrupt(), frame_.go_home(second_home_parameter);
    case code(30, 1): return frame_.store_home(second_home_parameter);
    case code(50): state_.scaling = Scaling{}; return true;
    case code(51): return frame_.set_scaling();
    case code(52):
    case code(92):
    case code(92, 1):
    case code(92, 2):
    case code(92, 3): return frame_.set_g92(number);
    case code(53):
      if (moves_straight()) return true;
      return fail("gcode.g53-without-move", words_.span(non_modal), "G53 without G0 or G1", "G53 G0 … or G53 G1 …");
    default: return true;  // G4 was executed before
  }
}

// G10. L tells what it sets.
bool BlockExecutor::set_table() {
  const double table = words_.has('L') ? words_['L'] : -1;
  if (table == 0) return tools_.reload_tools();
  if (table == 1 || table == 10 || table == 11) return tools_.set_tool_table_entry();
  if (table == 2 || table == 20) return frame_.set_work_offset();
  return fail("gcode.missing-word", words_.has('L') ? words_.span('L') : words_.span(non_modal),
              words_.has('L') ? fmt::format("there is no G10 L{}", plain_number(table)) : "G10 without L",
              "L0, L1, L2, L10, L11 or L20: G10 L2 P1 X… sets an offset, G10 L20 P1 X… makes this the given position, "
              "G10 L1 P1 Z… sets a tool");
}

bool BlockExecutor::stop(CodeNumber number) {
  // A fault is reported. The program stops all the same.
  (void)cutter_codes_.report(cutter_.release(), words_.span(stopping));
  switch (number) {
    case code(0): emit(operation::ProgramStop{}); return true;
    case code(1): emit(operation::OptionalProgramStop{}); return true;
    case code(60):
      emit(operation::PalletShuttle{});
      emit(operation::ProgramStop{});
      return true;
    case code(98):
    case code(99): return true;  // ProgramFlow::follow() executes them
    default: end_program(number == code(30)); return true;
  }
}

// M2 and M30 put the machine back into the state that programs may expect.
void BlockExecutor::end_program(bool pallet) {
  const auto is_on = [&](std::string_view name) {
    return block_.options.settings && block_.options.settings->is_on("RS274NGC", name);
  };
  if (!is_on("DISABLE_AUTO_G54")) frame_.activate_system(1, false);
  if (is_on("DISABLE_G92_PERSISTENCE")) (void)frame_.set_g92(code(92, 1));
  if (state_.modal.plane() != Plane::xy) emit(operation::SelectPlane{Plane::xy});
  emit(operation::SetFeedMode{});
  emit(operation::SetFeedRate{});
  if (!state_.feed_override) emit(operation::SetFeedOverride{true});
  for (std::uint8_t i = 0; i < state_.spindle_count; ++i) {
    if (!state_.spindles[i].speed_override) emit(operation::SetSpeedOverride{true, i});
    emit(operation::TurnSpindle{SpindleDirection::off, i});
    emit(operation::SetSpindleMode{0, i});
  }
  if (state_.mist) emit(operation::SetMist{false});
  if (state_.flood) emit(operation::SetFlood{false});
  if (pallet) emit(operation::PalletShuttle{});
  emit(operation::ProgramEnd{});
  block_.ended = true;
}

}  // namespace passo
