// Reads what a machine file says of the board's pins: [inputs], [outputs], windings on pins, and [silence]; and [work].
#pragma once

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

void read_inputs(TableReader& reader, PinsDescription& pins);
// The input at which the drive of an axis gives its alarm. No axis may be homed by it.
std::optional<int> read_alarm_input(TableReader& reader);
void check_alarm_input(const TomlReporter& reporter, const SourcePlace& place, const MachineDescription& machine,
                       std::size_t index);
void read_outputs(TableReader& reader, PinsDescription& pins);
void read_windings(TableReader& reader, BoardDescription& board);

void read_silence(TableReader& reader, SilenceDescription& silence);

// Usual values of the work, for the page. They are checked, and no motion depends on them.
void check_work(TableReader& reader);

}  // namespace passo
