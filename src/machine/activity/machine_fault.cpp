#include "passo/activity/machine_fault.hpp"

#include <cstddef>
#include <iterator>

namespace passo {
namespace {

using enum MachineFault;

constexpr MachineFaultRow rows[] = {
    {switch_not_met, "home.not-met", "its switch was not triggered", GrblAlarm::homing_no_switch},
    {switch_still_closed, "home.still-closed", "its switch is still triggered after the pull-off",
     GrblAlarm::homing_no_release},
    {switch_unsteady, "home.unsteady", "its switch opens and closes repeatedly", GrblAlarm::homing_no_release},
    {probe_before, "probe.before", "the probe was already in its final state before the move", GrblAlarm::probe_before},
    {probe_untouched, "probe.untouched", "the probe move finished without contact", GrblAlarm::probe_untouched},
    {probe_guard, "probe.guard", "the probe was triggered outside a probe move"},
    {program_wrong, "program.wrong", "the program cannot continue"},
    {program_waits, "run.waits",
     "{program} waits at {wait}, but there is no terminal to ask the operator: run it in a terminal, or add --yes when "
     "everything is prepared, with --resume to continue from here [run.waits]"},
    {spindle_failed, "run.spindle", "{why}: the program was stopped"},
    {board_stopped, "board.stopped", "{trouble}", GrblAlarm::hard_limit},
    {board_drivers_off, "board.drivers-off", "{trouble}", GrblAlarm::hard_limit},
    {board_slipped, "board.slipped", "{trouble}", GrblAlarm::hard_limit},
    {board_lost, "board.lost", "{trouble}", GrblAlarm::lost_place},
};

// A fault finds its row by its number.
constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    if (static_cast<std::size_t>(rows[i].fault) != i) return false;
  }
  return std::size(rows) == static_cast<std::size_t>(board_lost) + 1;
}
static_assert(rows_are_in_order());

}  // namespace

std::span<const MachineFaultRow> machine_fault_rows() {
  return rows;
}

const MachineFaultRow& row_of(MachineFault fault) {
  return rows[static_cast<std::size_t>(fault)];
}

std::string ActivityFault::message() const {
  return filled(row_of(fault).sentence, arguments);
}

Sentence ActivityFault::sentence() const {
  if (!trouble.code.empty()) return trouble;
  return {std::string(code()), arguments, message()};
}

bool is_of_board(MachineFault fault) {
  switch (fault) {
    case board_stopped:
    case board_drivers_off:
    case board_slipped:
    case board_lost: return true;
    default: return false;
  }
}

}  // namespace passo
