// ResumePoint: a place on the path of a program from which a job goes on, and all that was set on the way there.
//
// Found by going through the program again: what it means, and so where its path leads, is the same each time.
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
  std::array<std::int64_t, max_motors> steps{};  // of each motor from machine zero, at rest there
  OutputState outputs;                           // as they are there
  // As long as the program itself has waited after it had switched the spindle, before it went on.
  Seconds spindle_wait{0};
  bool in_thread = false;  // what comes there follows an encoder by place: it cannot begin there
  std::uint32_t line = 0;  // of the program, where it goes on; 0: at its end
};

// Of a program that was checked and does not probe. Nothing where its path has no such place.
std::optional<ResumePoint> find_resume_point(ProgramReader program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const PathPlace& place);

}  // namespace passo
