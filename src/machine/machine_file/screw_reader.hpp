// Reads the table [axis.X.screw] of a machine file: the backlash and the errors of pitch of an axis's screw.
#pragma once

#include <functional>
#include <optional>

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Reads the table within that of the axis, if there is one. What is wrong is reported and left out. `finish` is called
// with the table's reader when all is read.
std::optional<ScrewDescription> read_screw_of(TableReader& axis, bool rotary, const TomlReporter& reporter,
                                              const std::function<void(TableReader&)>& finish);

}  // namespace passo
