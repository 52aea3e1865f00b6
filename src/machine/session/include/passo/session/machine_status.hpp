// MachineStatus: the whole state of a machine at one moment, as a value. MachineChange: an event since then.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/activity/activity.hpp"
#include "passo/activity/homing_path.hpp"
#include "passo/base/sentence.hpp"
#include "passo/drive/holds.hpp"
#include "passo/interpreter/active_modes.hpp"
#include "passo/link/link.hpp"
#include "passo/session/known_position.hpp"
#include "passo/session/machine_state.hpp"
#include "passo/session/request.hpp"

namespace passo {

struct Overrides {
  double feed = 1;
  double adaptive_feed = 1;
  double spindle = 1;
  double rapids = 1;
  friend bool operator==(const Overrides&, const Overrides&) = default;
};

// Where programs wait for the operator.
struct ChosenStops {
  bool single_block = false;
  bool optional_stop = true;
  friend bool operator==(const ChosenStops&, const ChosenStops&) = default;
};

// The stop at which a program waits.
struct OperatorWait {
  Action::Kind kind = Action::Kind::program_stop;
  std::int32_t tool = 0;   // the tool, for a tool change
  std::uint32_t line = 0;  // the program's line
  // The number of the stop or tool change in the program, from 1; 0: unknown.
  std::uint64_t number = 0;
  std::string words = {};  // the program's message at that point, line by line; empty: none
  friend bool operator==(const OperatorWait&, const OperatorWait&) = default;
};
constexpr const char* code_of(const OperatorWait& wait) {
  if (wait.kind == Action::Kind::tool_change) return "M6";
  return wait.kind == Action::Kind::optional_stop ? "M1" : "M0";
}

struct ExecutedLine : OperationSource {
  ExecutedLine() = default;
  ExecutedLine(const OperationSource& source) : OperationSource(source) {}  // NOLINT: a line of which all is known

  // The last line that may be executed instead, on a board that does not report lines; 0: the line is exact.
  std::uint32_t to = 0;
  // The board runs this file of its own storage: its lines are not known here. Empty: there is none.
  std::string board_file = {};
  // In a program: the zero of its coordinates at that line, machine coordinates. It includes the tool's offset. Empty:
  // not known yet.
  std::optional<Point> work_zero = {};
};

struct MachineStatus {
  std::uint64_t version = 0;  // grows with each change
  Seconds time{0};            // on the board's side
  MachineState state = MachineState::offline;
  HoldReasons holds;         // why the machine is held
  bool rests = true;         // the machine is stopped
  KnownPosition position;    // the position; during motion: that of the last stop
  bool lost_place = false;   // MachineSession::lost_place(): no program can start
  Point now_at;              // with SessionOptions::tells_place: the last reported position
  MmPerSecond speed_now{0};  // along the path, between the last two reported positions
  Point ahead;               // during motion: the end of the planned motion
  std::optional<ActivityKind> activity;
  std::optional<double> progress;  // of the activity, 0 to 1
  Seconds committed{0};            // duration of the motion that can no longer be changed
  std::uint16_t inputs = 0;        // bits of BoardInput: the closed inputs
  OutputState outputs;             // the outputs as commanded by the program and the operator
  ExecutedLine executes;           // in a program: the executed line, as last reported
  Overrides overrides;
  ChosenStops stops;
  std::optional<OperatorWait> waits_for;
  std::optional<ToolMeasurement> measured_tool;  // in a program: by its last M6, if that measures
  std::optional<HomingStage> homing;             // the stage of homing; the next member is its axis
  std::optional<Axis> homing_axis;
  std::optional<LinkError> trouble;  // the error of an alarm or a fault
  Sentence trouble_sentence;
};

// The result of a request.
enum class Outcome : std::uint8_t {
  done,
  stopped,  // by a request, or because a keep-alive timeout expired
  failed,   // the fault gives the reason
};

struct MachineChange {
  enum class Kind : std::uint8_t {
    state,           // the machine is now in `state`
    answered,        // the request of `ticket` has ended with `outcome`
    came_to_rest,    // in a hold
    rested_by_tail,  // the board stopped because a queue update came too late; the path continues
    position_lost,   // the board's counts differ from the commanded position
    probed,          // a probe move has ended
  };
  Kind kind = Kind::state;
  Seconds time{0};
  MachineState state = MachineState::offline;
  Ticket ticket = 0;
  Outcome outcome = Outcome::done;
  std::optional<ActivityFault> fault = {};
  std::optional<ProbeOutcome> probe = {};
};

}  // namespace passo
