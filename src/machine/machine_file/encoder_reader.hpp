// Reads the table [axis.X.encoder] of a machine file: the encoder on an axis' motor, and its use by the drive.
#pragma once

#include <functional>
#include <optional>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Reads the table inside that of the axis, if there is one. Invalid values are reported and omitted. `finish` is called
// with the table's reader at the end.
std::optional<EncoderDescription> read_encoder_of(TableReader& axis, bool rotary, const TomlReporter& reporter,
                                                  const std::function<void(TableReader&)>& finish);

}  // namespace passo
