// ResumePoint: a point on the path of a program at which a job continues, with all modes and settings there.
//
// The place is found by interpreting the program again: its meaning, and so its path, is the same each time.
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

// A probe move with an unknown result: the host was gone before its end. The probe move is made again, from its
// beginning. The machine position is on the path of that move.
struct UnknownProbe {
  Point end;  // of the move, machine coordinates
  MmPerSecond speed{0};
};

struct ResumePoint {
  PathPlace place;
  Point point;                                   // machine coordinates
  std::array<std::int64_t, max_motors> steps{};  // steps of each motor from machine zero, at rest there
  AxisSet downs;                                 // the axes whose backlash is taken up for motion down
  OutputState outputs;                           // the outputs at that place
  // How long the program itself waited after it had switched the spindle, before it went on.
  Seconds spindle_wait{0};
  bool in_thread = false;  // the path there follows an encoder by place, and cannot begin there
  std::uint32_t line = 0;  // the program line at which the job continues; 0: at its end
  // The last commanded state, for the path to that point.
  std::int32_t tool = 0;                   // of its last tool change; 0: there was none
  MmPerSecond feed{0};                     // 0: nothing was fed
  std::optional<double> clearance = {};    // the height of its last rapid across, machine coordinates
  std::uint64_t stops = 0;                 // stops and tool changes before the place
  std::size_t probes = 0;                  // probe moves before the place; what they have found counts
  std::optional<UnknownProbe> probe = {};  // the point is the beginning of this one
};

// Finds `place` in a program that was checked. `probes`: what its first probe moves have found. Amid a probe move the
// place is moved on behind the move, if its outcome is known, or else back to its beginning. Empty: the path has no
// such place.
std::optional<ResumePoint> find_resume_point(ProgramReader program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const PathPlace& place,
                                             const std::vector<ProbeOutcome>& probes = {});

// The path back to the point from a position inside an unknown probe move. Empty: it stands there.
std::vector<PathItem> way_back_of_probe(const ResumePoint& point, const Point& from);

// A drive counts the items of a lead-in too, and the item amid which the path begins from there. Returns the rest as
// places on the path of the job. If the machine stops in the lead-in, its path still starts at the point.
BoardRest without_lead_in(const ResumePoint& from, std::size_t lead_in, BoardRest rest);

}  // namespace passo
