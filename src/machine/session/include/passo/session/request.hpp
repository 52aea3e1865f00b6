// Requests: the requests that a machine accepts. Each request is rejected immediately, or accepted with a ticket.
// Later, a change with that ticket reports the result.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/activity/jog_line.hpp"
#include "passo/activity/streamed_program.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/journal/resume_point.hpp"
#include "passo/session/known_position.hpp"
#include "passo/session/refusal.hpp"

namespace passo {

// Observers of the data of a run. Empty functions cost nothing.
struct Watchers {
  std::function<void(const Operation&)> operations;
  std::function<void(const PathItem&)> path;
  std::function<void(const MotionItem&)>
      planned;  // as planned; with a board on a link, a part of it may never be executed
  std::function<void(const MotionItem&)> motion;  // the same; with a board on a link, after its execution
  std::function<void(const BoardItem&)> items;
  std::function<void(const ProbeOutcome&)> probe;
  std::function<void(const LinkItem&)> executed;  // with a board on a link: the executed items, including stop ramps
  std::function<void(const BoardStop&)> rests;    // with a board on a link: the possible stop points, in advance
};

namespace request {

// Runs a program from the current position. The program must have been checked.
struct Start {
  ProgramReader program;
  InterpreterOptions options;            // the session sets `start`
  Seconds nominal_time{0};               // from the check, for progress
  bool waits_for_operator = true;        // the run waits at M0, M1 and M6
  bool live = true;                      // reacts immediately, and therefore plans less far ahead
  bool answers_probes = true;            // the board reports contacts; otherwise a probe move is triggered at its end
  std::optional<ResumePoint> from = {};  // the point of the path at which the job continues
  std::vector<PathItem> lead_in = {};    // from the current position to that point; empty: the machine is there
  // The start of the lead-in, if it is on the path of the job, so that the outputs of the job are switched on there.
  // Empty: the session knows the position.
  std::optional<Point> stands = {};
  std::vector<ProbeOutcome> known_probes = {};  // the results of the probe moves before `from`
  Watchers watchers = {};
  Diagnostics* findings = nullptr;  // collects findings during the run; must outlive the run. Null: none are collected
};
// Runs a program that arrives line by line, until Stop. While there is no line, the machine is stopped in the state
// await_line. The program starts at the current position.
struct Stream {
  StreamedProgram* program = nullptr;  // must outlive the stream
  Watchers watchers = {};
};
// For a stream: stops on the path, and drops the queued lines. The stream continues with the next line.
struct DropLines {};
// Moves axes as long as the keep-alive timeout (lease) is renewed. The machine begins to decelerate before the timeout.
// No axis moves towards a closed limit switch.
struct Jog {
  // The keep-alive timeout must be longer than the committed motion. After `longest_lease` without a renewal, the
  // operator is assumed to have left.
  static constexpr Seconds shortest_lease{0.1};
  static constexpr Seconds longest_lease{10};

  JogWay way;
  Seconds lease{0.25};  // duration of the first keep-alive timeout, and of each renewal
  // Of the speed of the way. A client that moves a ring or a stick changes it with a renewal, while the axes move.
  static constexpr double least_share = 0.02;
  double share = 1;
};
struct RenewKeepAlive {
  std::optional<double> share = {};  // as in Jog; empty: it stays
};
// Homes the machine, or one axis of it (Ability::home_axis).
struct Home {
  std::optional<Axis> axis = {};
};
// Makes one move that ends where the probe is triggered or opens.
struct Probe {
  Point target;  // machine coordinates
  MmPerSecond speed{0};
  bool toward = true;
};
// Checks a program without motion.
struct Check {
  ProgramReader program;
  InterpreterOptions options;
  Diagnostics* findings = nullptr;  // must outlive the check
};
// Has the board run a file of its own storage (Ability::board_files). Its lines do not come from here: nothing is known
// of its path, and the board interprets it.
struct RunBoardFile {
  std::string path;  // as BoardStorage lists it
};
// Feed hold: stops on the path. Activities other than programs end there.
struct Hold {
  // True: as for an open door. After the stop, spindle and coolant are switched off. Resuming switches them on again,
  // and waits for the spindle.
  bool for_door = false;
};
struct Resume {};
// Stops on the path and ends the activity.
struct Stop {};
// Changes overrides; empty ones stay as they are. Ranges: feed and spindle 0 to 2, the machine's own factor 0 to 1,
// rapids 0.05 to 1.
struct Override {
  std::optional<double> feed = {};
  std::optional<double> adaptive_feed = {};
  std::optional<double> spindle = {};
  std::optional<double> rapids = {};
};
// The operator's output switches during a program. Coolant stays as switched until the program switches it. The spindle
// can be stopped during a hold, and starts again on resume.
struct SwitchOutputs {
  std::optional<bool> mist = {};
  std::optional<bool> flood = {};
  std::optional<bool> spindle_stands = {};
};
// Where programs wait for the operator. Empty members stay as they are.
struct ChooseStops {
  std::optional<bool> single_block = {};   // a running program holds after each line
  std::optional<bool> optional_stop = {};  // programs wait at M1
};
// The operator confirms the stop at which the program waits: M0, M1 or M6.
struct OperatorDone {};
// Sets the machine position, as confirmed by the operator.
struct SetPosition {
  KnownPosition position;
};
// Repeats the handshake, e.g. after an alarm or a fault. The position stays known only if a board on a link has
// continued counting.
struct ResetMachine {};
struct Sleep {};
struct Wake {};

}  // namespace request

using Request =
    std::variant<request::Start, request::Stream, request::DropLines, request::Jog, request::RenewKeepAlive,
                 request::Home, request::Probe, request::Check, request::RunBoardFile, request::Hold, request::Resume,
                 request::Stop, request::Override, request::SwitchOutputs, request::ChooseStops, request::OperatorDone,
                 request::SetPosition, request::ResetMachine, request::Sleep, request::Wake>;

using Ticket = std::uint64_t;

}  // namespace passo
