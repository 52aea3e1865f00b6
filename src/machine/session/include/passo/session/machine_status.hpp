// MachineStatus: all that there is to know of a machine at one moment, as a value. MachineChange: one thing that has
// happened since.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/activity/activity.hpp"
#include "passo/activity/homing_path.hpp"
#include "passo/base/sentence.hpp"
#include "passo/drive/holds.hpp"
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

// Where programs wait for a person.
struct ChosenStops {
  bool single_block = false;
  bool optional_stop = true;
  friend bool operator==(const ChosenStops&, const ChosenStops&) = default;
};

// What the program waits for.
struct OperatorWait {
  Action::Kind kind = Action::Kind::program_stop;
  std::int32_t tool = 0;   // the tool, for a tool change
  std::uint32_t line = 0;  // the program's line
  // Which of the program's stops and tool changes, from 1; 0: not known.
  std::uint64_t number = 0;
  std::string words = {};  // what the program says there, line by line; empty: nothing
  friend bool operator==(const OperatorWait&, const OperatorWait&) = default;
};
constexpr const char* code_of(const OperatorWait& wait) {
  if (wait.kind == Action::Kind::tool_change) return "M6";
  return wait.kind == Action::Kind::optional_stop ? "M1" : "M0";
}

struct MachineStatus {
  std::uint64_t version = 0;  // grows with each change
  Seconds time{0};            // on the board's side
  MachineState state = MachineState::offline;
  HoldReasons holds;         // why the machine rests or brakes
  bool rests = true;         // no motion is under way
  KnownPosition position;    // at rest: where the machine stands; in motion: where it last rested
  bool lost_place = false;   // MachineSession::lost_place(): no program begins
  Point now_at;              // with SessionOptions::tells_place: where the board has last told that it is
  MmPerSecond speed_now{0};  // along the path, between the last two such places
  Point ahead;               // in motion: the end of what has been planned
  std::optional<ActivityKind> activity;
  std::optional<double> progress;  // of the activity, 0 to 1
  Seconds committed{0};            // time of the motion that nothing can change any more
  std::uint16_t inputs = 0;        // bits of BoardInput: the closed inputs
  OutputState outputs;             // the outputs as the program and the operator have ordered them
  OperationSource executes;        // in a program: the line that is being executed, as far as is known
  Overrides overrides;
  ChosenStops stops;
  std::optional<OperatorWait> waits_for;
  std::optional<HomingStage> homing;  // the stage of homing; the next member is its axis
  std::optional<Axis> homing_axis;
  std::optional<LinkError> trouble;  // the error of an alarm or a fault
  Sentence trouble_sentence;
};

// The result of a request.
enum class Outcome : std::uint8_t {
  done,
  stopped,  // somebody asked to stop, or a lease was over
  failed,   // the fault tells why
};

struct MachineChange {
  enum class Kind : std::uint8_t {
    state,           // the machine is now in `state`
    answered,        // the request of `ticket` has ended with `outcome`
    came_to_rest,    // in a hold
    rested_by_tail,  // the board rested because a refill came too late; the path goes on
    position_lost,   // the board's counts differ from what was commanded
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
