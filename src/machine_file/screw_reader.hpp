// Reads the table [axis.X.screw] of a machine file: the backlash and the errors of pitch of an axis's screw.
#pragma once

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// What is wrong is reported and left out.
ScrewDescription read_screw(TableReader& reader, bool rotary);

}  // namespace passo
