// Refusal: why a request is rejected. Each reason is one row of a table: the code that clients compare, a finer code
// for translations, and the English sentence.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "passo/base/sentence.hpp"

namespace passo {

enum class RefusalCode : std::uint8_t {
  busy,           // another activity is running
  not_ready,      // the board has not answered yet
  alarm,          // a reset is needed first
  asleep,         // a wake-up is needed first
  nothing_runs,   // there is nothing to hold, resume, stop or renew
  not_waiting,    // the program does not wait for the operator
  door_open,      // the door must be closed first
  no_switches,    // the machine has no switches for homing
  bad_value,      // not a number, or out of range
  limit_closed,   // a limit switch is closed: only a jog off it or homing is possible
  cannot,         // the board cannot do it
  place_unknown,  // the machine's position is unknown: only a jog, homing or a stated position is possible
};
std::string_view code_of(RefusalCode code);

enum class RefusalReason : std::uint8_t {
  busy,
  outputs_left_on,  // by lines sent before
  not_ready,
  // The board stopped the motors instantly, and why
  emergency_stop,
  limit_switch_of_axis,  // {axis}
  limit_switch,          // {number}
  drive_alarm,           // {axes}
  drivers_off,
  motors_stopped,
  board_lost,
  asleep,
  door_open,
  nothing_going_on,
  nothing_moves,
  no_lines_queued,
  no_jog,
  no_program_held,
  no_program_runs,
  spindle_turns,  // the spindle can be stopped only in a hold
  not_waiting,
  no_switches,
  bad_jog,
  bad_lease,
  bad_share,
  bad_probe,
  probe_leaves_travel,
  bad_override,
  bad_rapid_override,
  bad_place,
  board_cannot,           // {why}
  switch_closed,          // {number}
  switch_of_axes_closed,  // {axes}
  switch_closed_there,    // {axis}
  spindle_failed,         // {why}
  unknown_so_home,
  unknown_so_jog,
};

struct RefusalRow {
  RefusalReason reason;
  RefusalCode code;
  std::string_view finer_code;  // stable: the RefusalCode's own code, or one that starts with it
  std::string_view sentence;    // without a full stop; {name} is replaced by an argument
};
std::span<const RefusalRow> refusal_rows();
const RefusalRow& row_of(RefusalReason reason);

struct Refusal {
  RefusalReason reason = RefusalReason::busy;
  SentenceArguments arguments = {};

  RefusalCode code() const { return row_of(reason).code; }
  std::string message() const { return filled(row_of(reason).sentence, arguments); }
  Sentence sentence() const { return {std::string(row_of(reason).finer_code), arguments, message()}; }
};

}  // namespace passo
