// What kinematics = "corexy" demands of a machine file.
#pragma once

#include <span>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/toml_reporter.hpp"

namespace passo {

struct PlacedAxis {
  const AxisDescription& axis;
  SourceLocation place;  // of its table
};

// Reports what does not suit such a machine. `key`: the place of the key. `is_complete`: the file could be read to its
// end, so that what is missing is an error.
void check_core_xy(const TomlReporter& reporter, const SourceLocation& key, MachineUse use,
                   std::span<const PlacedAxis> axes, bool is_complete);

}  // namespace passo
