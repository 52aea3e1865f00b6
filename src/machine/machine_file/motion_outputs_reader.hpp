// Reads [output.N] and [laser]: the outputs that a program switches in motion.
#pragma once

#include <functional>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Reads both from the top of the file. `end` is called with the reader of each table at its end.
MotionOutputsDescription read_motion_outputs(TableReader& top, const TomlReporter& reporter,
                                             const std::function<void(TableReader&)>& end);

}  // namespace passo
