// Lengths on the command line and in job files: a number with an optional unit: 0.2, -0.3cm, 30mil, 1/32in.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Returns the millimetres per unit: mm, cm, inch, in, mil or um. Empty: not a unit.
std::optional<double> mm_of_unit(std::string_view name);

// `unit_mm`: the unit of numbers without one. The error is a message that names `option`.
Result<Mm, std::string> parse_length(const char* option, std::string_view text, double unit_mm);
// Parses several lengths separated by commas.
Result<std::vector<Mm>, std::string> parse_lengths(const char* option, std::string_view text, double unit_mm);

}  // namespace passo
