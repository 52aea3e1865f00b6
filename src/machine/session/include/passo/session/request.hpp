// Requests: what can be asked of a machine. Each request is refused at once, or taken with a ticket. Later, a change
// with that ticket tells the result.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/activity/jog_line.hpp"
#include "passo/activity/open_program.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/journal/resume_point.hpp"
#include "passo/session/known_position.hpp"
#include "passo/session/refusal.hpp"

namespace passo {

// Functions that watch the data of a run. Empty functions cost nothing.
struct Watchers {
  std::function<void(const Operation&)> operations;
  std::function<void(const PathItem&)> path;
  std::function<void(const MotionItem&)> planned;  // as it is planned; over a line a part of it may never be played
  std::function<void(const MotionItem&)> motion;   // the same; over a line as executed, after it was executed
  std::function<void(const BoardItem&)> items;
  std::function<void(const ProbeOutcome&)> probe;
  std::function<void(const LinkItem&)> executed;  // over a line: what the board has executed, tails included
  std::function<void(const BoardRest&)> rests;    // over a line: where the board may come to rest, told in advance
};

namespace request {

// Runs a program from where the machine stands. The program was checked before.
struct Start {
  ProgramReader program;
  InterpreterOptions options;            // the session sets `start`
  Seconds nominal_time{0};               // from the check, for progress
  bool waits_for_operator = true;        // the run waits at M0, M1 and M6
  bool live = true;                      // reacts at once, and therefore reads less far ahead
  bool answers_probes = true;            // the board answers; else a probe move is touched at its end
  std::optional<ResumePoint> from = {};  // where on its path the job goes on
  std::vector<PathItem> lead_in = {};    // from where the machine stands to there; empty: it stands there
  // Where the lead-in begins, if it is on the path of the job, so that the outputs of the job are switched on there.
  // Empty: the session knows where the machine stands.
  std::optional<Point> stands = {};
  std::vector<ProbeOutcome> known_probes = {};  // what the probe moves before `from` have found
  Watchers watchers = {};
  Diagnostics* findings = nullptr;  // gets what is found during the run; outlives the run. Null: nobody looks
};
// Runs a program that comes line by line, until Stop. While no line is there, the machine rests in the state
// await_line. The program is at the place where the machine stands.
struct Stream {
  OpenProgram* program = nullptr;  // outlives the stream
  Watchers watchers = {};
};
// Of a stream: brakes on the path, and drops what is queued. The stream goes on with the next line.
struct DropLines {};
// Moves axes for as long as the lease is renewed. The machine begins to brake before the lease is over. No axis moves
// towards a limit switch that is closed.
struct Jog {
  // A lease has to be longer than the committed motion. An operator who does not renew a lease for `longest_lease` is
  // gone.
  static constexpr Seconds shortest_lease{0.1};
  static constexpr Seconds longest_lease{10};

  JogWay way;
  Seconds lease{0.25};  // length of the first lease, and of each renewal
};
struct RenewLease {};
// Finds the machine's place by its switches.
struct Home {};
// Makes one move that ends where the probe gets touched or free.
struct Probe {
  Point target;  // machine coordinates
  MmPerSecond speed{0};
  bool toward = true;
};
// Checks a program without motion.
struct Check {
  ProgramReader program;
  InterpreterOptions options;
  Diagnostics* findings = nullptr;  // outlives the check
};
// Brakes on the path. What is no program ends there.
struct Hold {
  // True: as for an open door. At rest the spindle and the coolant are switched off too. A resume switches them on
  // again, and waits for the spindle.
  bool for_door = false;
};
struct Resume {};
// Brakes on the path and ends what is going on.
struct Stop {};
// Changes factors. An empty factor stays as it is. Feed and spindle are 0 to 2, the machine's own factor is 0 to 1,
// rapids are 0.05 to 1.
struct Override {
  std::optional<double> feed = {};
  std::optional<double> adaptive_feed = {};
  std::optional<double> spindle = {};
  std::optional<double> rapids = {};
};
// The operator's switches of a program. Coolant stays as switched until the program switches the same itself. The
// spindle can be stopped while the program rests in a hold; with the resume it turns again.
struct SwitchOutputs {
  std::optional<bool> mist = {};
  std::optional<bool> flood = {};
  std::optional<bool> spindle_stands = {};
};
// Where programs wait for a person. What is empty stays as it is.
struct ChooseStops {
  std::optional<bool> single_block = {};   // a program that runs rests in a hold after each of its lines
  std::optional<bool> optional_stop = {};  // programs wait at M1
};
// The operator has done what the program waits for: M0, M1, M6.
struct OperatorDone {};
// Says where the machine stands, as a person knows.
struct SetPosition {
  KnownPosition position;
};
// Says hello again, for instance after an alarm or a fault. The place stays known only if a board at the end of a line
// has gone on counting.
struct ResetMachine {};
struct Sleep {};
struct Wake {};

}  // namespace request

using Request =
    std::variant<request::Start, request::Stream, request::DropLines, request::Jog, request::RenewLease, request::Home,
                 request::Probe, request::Check, request::Hold, request::Resume, request::Stop, request::Override,
                 request::SwitchOutputs, request::ChooseStops, request::OperatorDone, request::SetPosition,
                 request::ResetMachine, request::Sleep, request::Wake>;

using Ticket = std::uint64_t;

}  // namespace passo
