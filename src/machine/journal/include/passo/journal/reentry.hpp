// Reentry: how a machine that stands somewhere else gets back onto the path of a program: up, spindle on, over, down.
//
// The place on the path is found by interpreting the program from its beginning, so all modes, offsets and outputs are
// those that the program itself has set there, and the path from there on is the same as in a whole run. Nothing moves
// until somebody has seen the steps. See docs/decisions/0081.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/activity/homing_path.hpp"
#include "passo/base/result.hpp"
#include "passo/base/sentence.hpp"
#include "passo/journal/resume_point.hpp"

namespace passo {

enum class ReentryRefusal : std::uint8_t {
  no_motion,     // no motion comes from that line on
  done_often,    // the line is done more than once, and no pass was chosen
  no_pass,       // the line is not done so often
  beyond_end,    // the path ends before that distance after the line
  other_file,    // a subprogram in another file has a line of that number too
  after_probe,   // the path to that point depends on a probe result
  path_changed,  // the path has no such place
  in_thread,     // a thread begins only at its own beginning
  backlash,      // the machine takes up backlash: a path begins with it taken up
  bad_program,   // the program has errors
};
std::string_view code_of(ReentryRefusal refusal);
// A sentence without a full stop.
std::string_view message_of(ReentryRefusal refusal);

// A point of a program's path: `after` a line's motion has begun, along the path. In loops and subprograms the path
// comes to a line several times: `pass` says which of them counts, 1 is the first. Times that follow each other without
// another line's motion between them are one pass.
struct LinePlace {
  std::uint32_t line = 0;
  std::uint32_t pass = 0;  // 0: the line is done once
  Mm after{0};
};
struct LineProblem {
  ReentryRefusal refusal = ReentryRefusal::no_motion;
  std::uint32_t times = 0;  // how often the line is done
};
std::string message_of(const LineProblem& problem);

// Where that point is. A line without motion means the next one with motion. A line that was merged with lines before
// it, because they go straight on, begins where the merged one does. Memory: 16 bytes a move.
Result<ResumePoint, LineProblem> find_line(const ProgramReader& program, const MachineDescription& machine,
                                           const InterpreterOptions& options, const LinePlace& wanted);

struct Reentry {
  ResumePoint at;
  std::vector<PathItem> lead_in;  // from the current position to that point; ends in a stop
  std::vector<Sentence> steps;    // the same for people, in order
};

// The range of each axis on a path between two places, the first of which comes first. `probes`: what its first probe
// moves have found.
std::optional<Box> range_between(ProgramReader program, const MachineDescription& machine,
                                 const InterpreterOptions& options, const PathPlace& first, const PathPlace& last,
                                 const std::vector<ProbeOutcome>& probes = {});

// After a board has lost its place, and the machine was homed: whether the machine had stood where its path allows.
// `range`: where the motors may have been stopped. `went`: how far the machine has gone from there to where homing
// began. Returns a sentence without a full stop for an axis that stood elsewhere; empty: none did.
std::string words_of_shift(const MachineDescription& machine, const std::vector<HomedAxis>& homed, const Box& range,
                           const Point& went);

// `from`: the current position, machine coordinates.
Result<Reentry, ReentryRefusal> plan_reentry(const MachineDescription& machine, const ResumePoint& at,
                                             const Point& from);

// Both together: the path to a point of the program from options.start, the current position.
Result<Reentry, LineProblem> reentry_at_line(const ProgramReader& program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const LinePlace& wanted);

}  // namespace passo
