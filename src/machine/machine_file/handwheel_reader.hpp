// Reads [handwheel]: a handwheel at pins of the board.
#pragma once

#include <functional>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// `axes`: those of the machine. Invalid values are reported and omitted. `finish` is called with the table's reader at
// the end.
HandwheelDescription read_handwheel(const TomlEntry& entry, const std::vector<AxisDescription>& axes,
                                    const TomlReporter& reporter, const std::function<void(TableReader&)>& finish);

}  // namespace passo
