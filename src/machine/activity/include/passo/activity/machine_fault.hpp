// MachineFault: the reason for the failure of an activity or of the board. Each fault is one row of a table: its stable
// code, its sentence, and grbl's alarm number. Code compares enumerators instead of texts, so the compiler rejects a
// fault that does not exist.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "passo/base/sentence.hpp"

namespace passo {

enum class MachineFault : std::uint8_t {
  // Homing
  switch_not_met,       // the switch did not close within 1.1 times the travel, or, on the slow return, within three
                        // times the pull-off
  switch_still_closed,  // the switch did not open within the pull-off
  switch_unsteady,      // the switch opened and closed repeatedly
  // Probing
  probe_before,     // the probe was already in the final state before the move began
  probe_untouched,  // the move ended without a contact
  probe_guard,      // the probe was triggered outside a probe move
  // Programs
  program_wrong,   // an error was found only during the run
  program_waits,   // the program waits for an operator, but there is none
  spindle_failed,  // {why}: the drive of a spindle that this computer controls
  // The board; {trouble} is the board's own error
  board_stopped,      // the board stopped its motors instantly
  board_drivers_off,  // the board switched the drivers off
  board_slipped,      // the motors stopped during motion, because events came too late
  board_lost,
};

// Alarm numbers (ALARM:n) of grbl.
enum class GrblAlarm : std::uint8_t {
  none = 0,
  hard_limit = 1,
  soft_limit = 2,
  lost_place = 3,
  probe_before = 4,
  probe_untouched = 5,
  homing_stopped = 6,
  homing_no_release = 8,
  homing_no_switch = 9,
  motor_fault = 17,  // grblHAL's number
};

struct MachineFaultRow {
  MachineFault fault;
  std::string_view code;      // stable
  std::string_view sentence;  // without a full stop; {name} is replaced by an argument
  GrblAlarm alarm = GrblAlarm::none;
};
std::span<const MachineFaultRow> machine_fault_rows();
const MachineFaultRow& row_of(MachineFault fault);

// A fault that has happened, with the arguments of its sentence.
struct ActivityFault {
  MachineFault fault = MachineFault::program_wrong;
  SentenceArguments arguments = {};
  Sentence trouble = {};  // for a fault of the board: the board's own error

  std::string_view code() const { return row_of(fault).code; }
  // The sentence with its arguments.
  std::string message() const;
  // Returns the board's own error for a fault of the board, because it is more specific, otherwise the fault's
  // sentence.
  Sentence sentence() const;
};

// True if the board has failed, not the work. An interrupted job can then continue later.
bool is_of_board(MachineFault fault);

}  // namespace passo
