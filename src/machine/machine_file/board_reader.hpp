// Reads [board]: the clock, the highest event rate and the times of the board.
#pragma once

#include <optional>

#include "passo/machine_file/machine_description.hpp"
#include "passo/toml/table_reader.hpp"

namespace passo {

// Returns the highest event rate. Empty: it is missing or wrong.
std::optional<Hertz> read_board(TableReader& reader, BoardDescription& board);

}  // namespace passo
