// Lengths on the command line: a number, and perhaps its unit: 0.2, -0.3cm, 30mil, 1/32in.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The millimetres of a unit: mm, cm, inch, in, mil or um. Empty: no unit.
std::optional<double> mm_of_unit(std::string_view name);

// `unit_mm`: of numbers without a unit. The failure is a message that names `option`.
Result<Mm, std::string> parse_length(const char* option, std::string_view text, double unit_mm);
// Several lengths with commas between.
Result<std::vector<Mm>, std::string> parse_lengths(const char* option, std::string_view text, double unit_mm);

}  // namespace passo
