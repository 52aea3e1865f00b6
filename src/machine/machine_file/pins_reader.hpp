// Reads the board's pins in a machine file: [inputs], [outputs], windings on pins, and [silence]; and checks [work].
#pragma once

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

void read_inputs(TableReader& reader, PinsDescription& pins);
// Reads the alarm input of an axis' drive. That input must not be used for homing.
std::optional<int> read_alarm_input(TableReader& reader);
void check_alarm_input(const TomlReporter& reporter, const SourceLocation& place, const MachineDescription& machine,
                       std::size_t index);
void read_outputs(TableReader& reader, PinsDescription& pins);
void read_windings(TableReader& reader, BoardDescription& board);

void read_silence(TableReader& reader, SilenceDescription& silence);

// Checks the default values for workpieces, which the web interface uses. No motion depends on them.
void check_work(TableReader& reader);

}  // namespace passo
