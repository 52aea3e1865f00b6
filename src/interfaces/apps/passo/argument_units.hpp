// Units of arguments, in those of the program.
#pragma once

#include <numbers>

namespace passo {

inline constexpr double radians_per_degree = std::numbers::pi / 180;
inline constexpr double henries_per_millihenry = 1e-3;

}  // namespace passo
