// MachineFault: why something that the machine was asked for has failed while it was done. Each fault is one row of a
// table: its stable code, its sentence, and grbl's number for it. What compares faults compares enumerators, so the
// compiler finds a fault that does not exist.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "passo/base/sentence.hpp"

namespace passo {

enum class MachineFault : std::uint8_t {
  // Homing
  switch_not_met,       // the switch did not close within 1.1 of the travel, or, on the slow return, within three times
                        // the pull-off
  switch_still_closed,  // the switch did not open within the pull-off
  switch_unsteady,      // the switch opened and closed again and again
  // Probing
  probe_before,     // the probe was as it should become before the move began
  probe_untouched,  // the move came to its end without a contact
  probe_guard,      // the probe was touched in a move that is no probe move
  // Programs
  program_wrong,  // an error came true only in the run
  program_waits,  // the program waits for a person, and there is nobody to ask
  // The board: {trouble} says what it is
  board_stopped,      // it has stopped its motors at once
  board_drivers_off,  // it has switched the drivers off
  board_slipped,      // its motors were stopped amid motion
  board_lost,
};

// ALARM:n of grbl.
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
  motor_fault = 17,  // as grblHAL numbers it
};

struct MachineFaultRow {
  MachineFault fault;
  std::string_view code;      // stable
  std::string_view sentence;  // without a full stop; {name} stands for an argument
  GrblAlarm alarm = GrblAlarm::none;
};
std::span<const MachineFaultRow> machine_fault_rows();
const MachineFaultRow& row_of(MachineFault fault);

// A fault that has happened, with what its sentence tells.
struct ActivityFault {
  MachineFault fault = MachineFault::program_wrong;
  SentenceArguments arguments = {};
  Sentence trouble = {};  // of a fault of the board: what is wrong with the board

  std::string_view code() const { return row_of(fault).code; }
  // The sentence with its arguments.
  std::string message() const;
  // Of a fault of the board, the board's own trouble: it says more.
  Sentence sentence() const;
};

// True: the board, and not the work, has failed. What was going on may go on later.
bool is_of_board(MachineFault fault);

}  // namespace passo
