// ResumePoint: a place on the path of a program from which a job goes on, and all that was set on the way there.
//
// The place is found by interpreting the program again: its meaning, and so its path, is the same each time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "passo/drive/rewindable_path.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

struct ResumePoint {
  PathPlace place;
  Point point;                                   // machine coordinates
  std::array<std::int64_t, max_motors> steps{};  // steps of each motor from machine zero, at rest there
  AxisSet downs;                                 // the axes whose backlash is taken up for motion down
  OutputState outputs;                           // the outputs at that place
  // How long the program itself waited after it had switched the spindle, before it went on.
  Seconds spindle_wait{0};
  bool in_thread = false;  // the path there follows an encoder by place, and cannot begin there
  std::uint32_t line = 0;  // the program's line where the job goes on; 0: at its end
  // What the program asked for last, for the way there.
  std::int32_t tool = 0;                 // of its last tool change; 0: there was none
  MmPerSecond feed{0};                   // 0: nothing was fed
  std::optional<double> clearance = {};  // the height of its last rapid across, machine coordinates
};

// Finds `place` in a program that was checked and does not probe. Empty: the path has no such place.
std::optional<ResumePoint> find_resume_point(ProgramReader program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const PathPlace& place);

}  // namespace passo
