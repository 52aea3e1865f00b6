// The kerf of a hot wire, as given on the command line: "1.2", or "1.6@100,1@200", widths measured at speeds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "length_arguments.hpp"

#include "passo/cam/wire_cut.hpp"

namespace passo {

// Returns the kerfs by increasing speed. `feed`: the speed, in mm/min, to which a width without a speed belongs;
// nothing: such a width applies to all speeds.
std::vector<WireKerf> kerfs_of(const char* option, const std::string& text, std::optional<double> feed,
                               LengthArguments& lengths);

}  // namespace passo
