#include "passo/session/refusal.hpp"

#include <cstddef>
#include <iterator>

namespace passo {
namespace {

using enum RefusalReason;

constexpr RefusalRow all_refusals[] = {
    {busy, RefusalCode::busy, "machine.busy", "the machine is busy"},
    {outputs_left_on, RefusalCode::busy, "machine.busy.outputs-left-on",
     "earlier lines left the spindle or the coolant on, or are still running: send M5 M9, or stop, first"},
    {not_ready, RefusalCode::not_ready, "machine.not-ready", "the board has not answered yet"},
    {emergency_stop, RefusalCode::alarm, "machine.alarm.emergency-stop",
     "the emergency stop was pressed: reset the machine first"},
    {limit_switch_of_axis, RefusalCode::alarm, "machine.alarm.limit-switch-of-axis",
     "the limit switch of {axis} closed: reset the machine first"},
    {limit_switch, RefusalCode::alarm, "machine.alarm.limit-switch",
     "limit switch {number} closed: reset the machine first"},
    {drive_alarm, RefusalCode::alarm, "machine.alarm.drive-alarm",
     "the drive of {axes} reported an alarm: reset the machine first"},
    {drivers_off, RefusalCode::alarm, "machine.alarm.drivers-off",
     "the drivers were switched off: reset the machine first"},
    {motors_stopped, RefusalCode::alarm, "machine.alarm", "the motors were stopped instantly: reset the machine first"},
    {board_lost, RefusalCode::alarm, "machine.alarm.board-lost", "the board was lost: reset the machine first"},
    {asleep, RefusalCode::asleep, "machine.asleep", "the machine is asleep: wake it first"},
    {door_open, RefusalCode::door_open, "machine.door-open", "the door is open"},
    {nothing_going_on, RefusalCode::nothing_runs, "machine.nothing-runs", "nothing is running"},
    {nothing_moves, RefusalCode::nothing_runs, "machine.nothing-runs.motion", "the machine is not moving"},
    {no_lines_queued, RefusalCode::nothing_runs, "machine.nothing-runs.lines", "no lines are queued"},
    {no_jog, RefusalCode::nothing_runs, "machine.nothing-runs.jog", "no jog is active"},
    {no_program_held, RefusalCode::nothing_runs, "machine.nothing-runs.hold", "no program is on hold"},
    {no_program_runs, RefusalCode::nothing_runs, "machine.nothing-runs.program", "no program is running"},
    {spindle_turns, RefusalCode::nothing_runs, "machine.nothing-runs.spindle",
     "the spindle can be stopped only on hold, when the machine has stopped"},
    {not_waiting, RefusalCode::not_waiting, "machine.not-waiting", "the program is not waiting for the operator"},
    {no_switches, RefusalCode::no_switches, "machine.no-switches", "no axis has a homing switch (table [axis.X.home])"},
    {bad_jog, RefusalCode::bad_value, "machine.bad-value.jog", "a jog needs a direction, and a speed above 0"},
    {bad_lease, RefusalCode::bad_value, "machine.bad-value.lease", "the keep-alive timeout of a jog is 0.1 to 10 s"},
    {bad_share, RefusalCode::bad_value, "machine.bad-value.share", "the share of a jog's speed is 0.02 to 1"},
    {bad_probe, RefusalCode::bad_value, "machine.bad-value.probe", "a probe move needs a target, and a speed above 0"},
    {probe_leaves_travel, RefusalCode::bad_value, "machine.bad-value.probe-travel",
     "the probe move would leave the machine's travel"},
    {bad_override, RefusalCode::bad_value, "machine.bad-value.override",
     "an override is a factor of 0 to 2, the machine's own 0 to 1"},
    {bad_rapid_override, RefusalCode::bad_value, "machine.bad-value.rapid-override",
     "the override of rapids is a factor of 0.05 to 1"},
    {bad_place, RefusalCode::bad_value, "machine.bad-value.place", "a position needs a number for each axis"},
    {board_cannot, RefusalCode::cannot, "machine.cannot", "{why}"},
    {switch_closed, RefusalCode::limit_closed, "machine.limit-closed",
     "limit switch {number} is closed: jog off it, or home the machine, first"},
    {switch_of_axes_closed, RefusalCode::limit_closed, "machine.limit-closed.of-axes",
     "the limit switch of {axes} is closed: jog off it, or home the machine, first"},
    {switch_closed_there, RefusalCode::limit_closed, "machine.limit-closed.there",
     "the limit switch of {axis} is closed at that end: move the other way"},
    {spindle_failed, RefusalCode::not_ready, "machine.not-ready.spindle", "the spindle is not ready: {why}"},
    {unknown_so_home, RefusalCode::place_unknown, "run.place-unknown",
     "the machine position is unknown: home it first"},
    {unknown_so_jog, RefusalCode::place_unknown, "run.place-unknown.no-homing",
     "the machine position is unknown: jog to a known position, and confirm it"},
};

// A reason finds its row by its number.
constexpr bool rows_are_in_order() {
  for (std::size_t i = 0; i < std::size(all_refusals); ++i) {
    if (static_cast<std::size_t>(all_refusals[i].reason) != i) return false;
  }
  return std::size(all_refusals) == static_cast<std::size_t>(unknown_so_jog) + 1;
}
static_assert(rows_are_in_order());

}  // namespace

std::string_view code_of(RefusalCode code) {
  switch (code) {
    case RefusalCode::busy: return "machine.busy";
    case RefusalCode::not_ready: return "machine.not-ready";
    case RefusalCode::alarm: return "machine.alarm";
    case RefusalCode::asleep: return "machine.asleep";
    case RefusalCode::nothing_runs: return "machine.nothing-runs";
    case RefusalCode::not_waiting: return "machine.not-waiting";
    case RefusalCode::door_open: return "machine.door-open";
    case RefusalCode::no_switches: return "machine.no-switches";
    case RefusalCode::bad_value: return "machine.bad-value";
    case RefusalCode::limit_closed: return "machine.limit-closed";
    case RefusalCode::cannot: return "machine.cannot";
    case RefusalCode::place_unknown: return "run.place-unknown";
  }
  return "machine";
}

std::span<const RefusalRow> refusal_rows() {
  return all_refusals;
}

const RefusalRow& row_of(RefusalReason reason) {
  return all_refusals[static_cast<std::size_t>(reason)];
}

}  // namespace passo
