// Reads the table [axis.X.encoder] of a machine file: the encoder on an axis's motor, and what its drive does with it.
#pragma once

#include <functional>
#include <optional>

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

// Reads the table within that of the axis, if there is one. What is wrong is reported and left out. `finish` is called
// with the table's reader when all is read.
std::optional<EncoderDescription> read_encoder_of(TableReader& axis, bool rotary, const TomlReporter& reporter,
                                                  const std::function<void(TableReader&)>& finish);

}  // namespace passo
