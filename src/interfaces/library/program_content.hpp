// Program::Content and Machine::Content. Private to library/.
#pragma once

#include "passo/gcode/program_reader.hpp"
#include "passo/library/check.hpp"
#include "passo/library/gcode.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo::v1 {

struct Program::Content {
  passo::ProgramReader reader;  // never read: again() makes readers
};

struct Machine::Content {
  passo::MachineDescription description;
};

}  // namespace passo::v1
