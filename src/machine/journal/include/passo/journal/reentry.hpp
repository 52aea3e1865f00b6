// Reentry: how a machine at another position returns to the path of a program: raise Z, start the spindle, traverse,
// plunge.
//
// The point on the path is found by interpreting the program from its beginning. So all modal states, offsets and
// outputs are those set by the program itself, and the path from there on is the same as in a complete run. Nothing
// moves before the operator has seen the steps. See docs/decisions/0081.
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
  no_motion,     // no motion follows from that line on
  done_often,    // the line is executed more than once, and no pass was chosen
  no_pass,       // the line has fewer passes
  beyond_end,    // the path ends before that distance after the line
  other_file,    // a subprogram in another file has a line with that number too
  after_probe,   // the path to that point depends on a probe result
  path_changed,  // the path does not contain that position
  in_thread,     // a thread can be entered only at its beginning
  backlash,      // the machine compensates backlash: a path begins with backlash taken up
  bad_program,   // the program has errors
};
std::string_view code_of(ReentryRefusal refusal);
// A sentence without a full stop.
std::string_view message_of(ReentryRefusal refusal);

// A point of a program's path: the distance `after` along the path from the start of a line's motion. In loops and
// subprograms the path reaches a line several times: `pass` selects one, counted from 1. Repetitions without another
// line's motion in between are one pass.
struct LinePlace {
  std::uint32_t line = 0;
  std::uint32_t pass = 0;  // 0: the line is executed only once
  Mm after{0};
};
struct LineProblem {
  ReentryRefusal refusal = ReentryRefusal::no_motion;
  std::uint32_t times = 0;  // how often the line is executed
};
std::string message_of(const LineProblem& problem);

// Finds that point. A line without motion stands for the next one with motion. A line that was merged with collinear
// lines before it begins where the merged line does. Memory: 16 bytes per move.
Result<ResumePoint, LineProblem> find_line(const ProgramReader& program, const MachineDescription& machine,
                                           const InterpreterOptions& options, const LinePlace& wanted);

struct Reentry {
  ResumePoint at;
  std::vector<PathItem> lead_in;  // from the current position to that point; ends in a stop
  std::vector<Sentence> steps;    // the same as sentences for the operator, in order
};

// Returns the range of each axis on the path between two positions, in path order. `probes`: the results of its first
// probe moves.
std::optional<Box> range_between(ProgramReader program, const MachineDescription& machine,
                                 const InterpreterOptions& options, const PathPosition& first, const PathPosition& last,
                                 const std::vector<ProbeOutcome>& probes = {});

// After a board has lost its position, and the machine was homed: checks whether the machine had been stopped on its
// path. `range`: the possible stop positions of the motors. `went`: the distance that the machine has moved from there
// to the start of homing. Returns a sentence without a full stop for an axis outside its range; empty: none is.
std::string words_of_shift(const MachineDescription& machine, const std::vector<HomedAxis>& homed, const Box& range,
                           const Point& went);

// Plans the return to the path. `from`: the current position, machine coordinates.
Result<Reentry, ReentryRefusal> plan_reentry(const MachineDescription& machine, const ResumePoint& at,
                                             const Point& from);

// Combines both: plans the return from options.start, the current position, to a point of the program.
Result<Reentry, LineProblem> reentry_at_line(const ProgramReader& program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const LinePlace& wanted);

}  // namespace passo
