// ResumePoint: a point on the path of a program at which a job continues, with all modal states and settings there.
//
// The point is found by interpreting the program again, which gives the same path each time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "passo/drive/feed.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// A probe move with an unknown result, because the host ended before the move did. The probe move is repeated from its
// beginning. The machine position is on the path of that move.
struct UnknownProbe {
  Point end;  // end of the move, machine coordinates
  MmPerSecond speed{0};
};

struct ResumePoint {
  PathPosition place;
  Point point;                                   // machine coordinates
  std::array<std::int64_t, max_motors> steps{};  // steps of each motor from machine zero, for a machine stopped there
  AxisSet downs;                                 // the axes whose backlash is taken up for motion in the negative
                                                 // direction
  OutputState outputs;                           // the outputs at that point
  std::uint8_t switches = 0;                     // the digital outputs that the path has switched in motion
  // How long the program itself waited after switching the spindle.
  Seconds spindle_wait{0};
  bool in_thread = false;  // the path there is locked to the spindle's angle, so it cannot be entered there
  std::uint32_t line = 0;  // the program line at which the job continues; 0: at its end
  Point work_zero{};       // zero of the work coordinate system of the last move, machine coordinates
  // The last commanded state, for the path to that point.
  std::int32_t tool = 0;                   // tool of the last tool change; 0: there was none
  MmPerSecond feed{0};                     // 0: there was no feed move
  std::optional<double> clearance = {};    // Z of the last traverse rapid, machine coordinates
  std::uint64_t stops = 0;                 // number of stops and tool changes before the point
  std::size_t probes = 0;                  // number of probe moves before the point, whose results are needed
  std::optional<UnknownProbe> probe = {};  // the point is the beginning of this one
};

// Finds `place` in a program that was checked. `probes`: the results of its first probe moves. Inside a probe move, the
// point is moved to the end of the move if its result is known, otherwise to its beginning. Empty: the path does not
// contain that position.
std::optional<ResumePoint> find_resume_point(ProgramReader program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const PathPosition& place,
                                             const std::vector<ProbeOutcome>& probes = {});

// Returns the path back to the point from a position inside an unknown probe move. Empty: the machine is at the point.
std::vector<PathItem> way_back_of_probe(const ResumePoint& point, const Point& from);

// Corrects a stop for the lead-in, whose items a drive counts too, and for the item inside which the path begins.
// Returns the stop as a position on the path of the job. If the machine stops in the lead-in, its path still starts at
// the point.
BoardStop without_lead_in(const ResumePoint& from, std::size_t lead_in, BoardStop rest);

}  // namespace passo
