// MachineState: the state of a machine, and the table of all transitions between states.
//
// The table is data. MachineSession follows it, docs/machine-states.md is generated from it, and a test checks each
// cell. A transition that is not in the table does not exist: the session refuses a request that would need it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace passo {

enum class MachineState : std::uint8_t {
  offline,      // no board has answered yet, or a handshake is in progress
  idle,         // stopped and ready
  run,          // a program runs
  hold,         // a program is held or stopped, by the operator or by the program (M0, M1)
  jog,          // the operator moves axes
  home,         // the machine finds its position with the switches
  probe,        // a probe move
  tool_change,  // a program waits for another tool (M6)
  await_line,   // a program that comes line by line waits for its next line
  check,        // a program is checked without motion
  door,         // the door is open, or was opened and start has not been pressed since
  alarm,        // the motors were stopped instantly, so the position is unreliable
  fault,        // the board does not answer, or does not suit the machine
  sleep,        // stopped; only waking is accepted
};
inline constexpr std::size_t state_count = 14;

enum class MachineEvent : std::uint8_t {
  ready,  // the handshake is complete
  begin_run,
  begin_jog,
  begin_home,
  begin_probe,
  begin_check,
  hold,       // a hold is requested by a client or by the program (M0, M1)
  resume,     // no hold reason is left
  want_tool,  // the program comes to a tool change
  want_line,  // the program has no further line yet
  open_door,
  close_door,    // the door closes, and there is no activity
  end,           // the activity has ended or was stopped
  stop_at_once,  // a limit, an emergency stop: steps may be lost
  lose_board,    // no answer, a reset, another protocol
  reset,         // start again with a handshake
  fall_asleep,
  wake,
};
inline constexpr std::size_t event_count = 18;

struct Transition {
  MachineState from;
  MachineEvent event;
  MachineState to;
};

// The properties of a state, whatever led to it.
struct StateRow {
  MachineState state;
  std::string_view name;     // as shown to users and in status lines
  bool has_activity;         // an activity is running or held
  bool may_move;             // motors may turn; in all other states the machine is stopped
  bool program_has_outputs;  // spindle and coolant are as programmed; in all other states they are off
};

// In a fault, and afterwards until the board has answered, motion and outputs are unknown: a board without a connection
// executes its stop ramp to the end, and keeps its outputs. In the state door, there may be a stopped activity or none.
inline constexpr std::array<StateRow, state_count> state_rows = {{
    {MachineState::offline, "Offline", false, true, true},
    {MachineState::idle, "Idle", false, false, false},
    {MachineState::run, "Run", true, true, true},
    {MachineState::hold, "Hold", true, true, true},
    {MachineState::jog, "Jog", true, true, false},
    {MachineState::home, "Home", true, true, false},
    {MachineState::probe, "Probe", true, true, false},
    {MachineState::tool_change, "Tool", true, false, true},
    {MachineState::await_line, "Line", true, false, true},
    {MachineState::check, "Check", true, false, false},
    {MachineState::door, "Door", true, true, true},
    {MachineState::alarm, "Alarm", false, false, false},
    {MachineState::fault, "Fault", false, true, true},
    {MachineState::sleep, "Sleep", false, false, false},
}};
constexpr const StateRow& row_of(MachineState state) {
  return state_rows[static_cast<std::size_t>(state)];
}

inline constexpr auto transitions = [] {
  using enum MachineState;
  using Event = MachineEvent;
  return std::array{
      Transition{offline, Event::ready, idle},
      Transition{offline, Event::stop_at_once, alarm},
      Transition{offline, Event::lose_board, fault},

      Transition{idle, Event::begin_run, run},
      Transition{idle, Event::begin_jog, jog},
      Transition{idle, Event::begin_home, home},
      Transition{idle, Event::begin_probe, probe},
      Transition{idle, Event::begin_check, check},
      Transition{idle, Event::open_door, door},
      Transition{idle, Event::stop_at_once, alarm},
      Transition{idle, Event::lose_board, fault},
      Transition{idle, Event::reset, offline},
      Transition{idle, Event::fall_asleep, sleep},

      Transition{run, Event::hold, hold},
      Transition{run, Event::want_tool, tool_change},
      Transition{run, Event::want_line, await_line},
      Transition{run, Event::open_door, door},
      Transition{run, Event::end, idle},
      Transition{run, Event::stop_at_once, alarm},
      Transition{run, Event::lose_board, fault},

      Transition{hold, Event::resume, run},
      Transition{hold, Event::want_tool, tool_change},
      Transition{hold, Event::want_line, await_line},
      Transition{hold, Event::open_door, door},
      Transition{hold, Event::end, idle},
      Transition{hold, Event::stop_at_once, alarm},
      Transition{hold, Event::lose_board, fault},

      Transition{tool_change, Event::resume, run},
      Transition{tool_change, Event::hold, hold},
      Transition{tool_change, Event::want_line, await_line},
      Transition{tool_change, Event::open_door, door},
      Transition{tool_change, Event::end, idle},
      Transition{tool_change, Event::stop_at_once, alarm},
      Transition{tool_change, Event::lose_board, fault},

      Transition{await_line, Event::resume, run},
      Transition{await_line, Event::hold, hold},
      Transition{await_line, Event::want_tool, tool_change},
      Transition{await_line, Event::open_door, door},
      Transition{await_line, Event::end, idle},
      Transition{await_line, Event::stop_at_once, alarm},
      Transition{await_line, Event::lose_board, fault},

      Transition{door, Event::resume, run},
      Transition{door, Event::hold, hold},
      Transition{door, Event::want_tool, tool_change},
      Transition{door, Event::want_line, await_line},
      Transition{door, Event::close_door, idle},
      Transition{door, Event::end, idle},
      Transition{door, Event::stop_at_once, alarm},
      Transition{door, Event::lose_board, fault},

      Transition{jog, Event::end, idle},
      Transition{jog, Event::stop_at_once, alarm},
      Transition{jog, Event::lose_board, fault},
      Transition{home, Event::end, idle},
      Transition{home, Event::stop_at_once, alarm},
      Transition{home, Event::lose_board, fault},
      Transition{probe, Event::end, idle},
      Transition{probe, Event::stop_at_once, alarm},
      Transition{probe, Event::lose_board, fault},
      Transition{check, Event::end, idle},
      Transition{check, Event::stop_at_once, alarm},
      Transition{check, Event::lose_board, fault},

      Transition{alarm, Event::reset, offline},
      Transition{alarm, Event::lose_board, fault},
      Transition{fault, Event::reset, offline},
      Transition{sleep, Event::wake, idle},
      Transition{sleep, Event::stop_at_once, alarm},
      Transition{sleep, Event::lose_board, fault},
  };
}();

// The state to which an event leads. Empty: the event may not happen in this state.
constexpr std::optional<MachineState> next_state(MachineState from, MachineEvent event) {
  for (const Transition& one : transitions) {
    if (one.from == from && one.event == event) return one.to;
  }
  return {};
}

constexpr std::string_view name_of(MachineState state) {
  return row_of(state).name;
}
std::string_view name_of(MachineEvent event);

// The text of docs/machine-states.md: the diagram, and the two tables.
std::string state_page();

}  // namespace passo
