// Reads [spindle]: its encoder, its run-up, how the simulated one behaves, and its drive on a bus of this computer.
#pragma once

#include <functional>
#include <memory>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

SpindleDescription read_spindle(TableReader& reader);
// [spindle.modbus]. `highest_rpm`: max_rpm of [tool].
std::shared_ptr<const SpindleBusDescription> read_spindle_bus(const TomlEntry& entry, double highest_rpm,
                                                              const TomlReporter& reporter,
                                                              const std::function<void(TableReader&)>& finish);

}  // namespace passo
