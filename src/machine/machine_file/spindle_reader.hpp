// Reads [spindle]: its encoder, its run-up, and how the simulated one behaves.
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

SpindleDescription read_spindle(TableReader& reader);

}  // namespace passo
