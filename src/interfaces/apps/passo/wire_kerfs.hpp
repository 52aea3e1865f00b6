// The kerf of a hot wire, as the command line says it: "1.2", or "1.6@100,1@200", widths that were measured at speeds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "length_arguments.hpp"

#include "passo/cam/wire_cut.hpp"

namespace passo {

// By rising speed. `feed`: the speed of a width without one, mm a minute; nothing: such a width is that of all speeds.
std::vector<WireKerf> kerfs_of(const char* option, const std::string& text, std::optional<double> feed,
                               LengthArguments& lengths);

}  // namespace passo
