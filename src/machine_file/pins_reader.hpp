// Reads what a machine file says of the board's pins: [inputs], [outputs], and windings on pins.
#pragma once

#include "table_reader.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

void read_inputs(TableReader& reader, PinsDescription& pins);
void read_outputs(TableReader& reader, PinsDescription& pins);
void read_windings(TableReader& reader, BoardDescription& board);

// A time after which a silent host's outputs end: whole tenths of a second, or 0. Reports anything else.
void read_tenths(TableReader& reader, const NumberKey& key, Seconds& time);

}  // namespace passo
