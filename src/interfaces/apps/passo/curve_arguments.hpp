// CurveArguments: creates a curve from command-line arguments.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "commands.hpp"

#include "passo/base/result.hpp"
#include "passo/geometry/bezier.hpp"
#include "passo/geometry/curve_in_space.hpp"
#include "passo/geometry/ellipse.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {

using AnyCurve = std::variant<CurveInSpace, Ellipse, QuadraticBezier, CubicBezier, Nurbs>;

// The error text can follow "passo: error: ".
Result<AnyCurve, std::string> curve_of(const ChordsArguments& arguments);

// Parses "1,2.5,-3" as `least` to `most` numbers. `what` describes the expected input: "X,Y or X,Y,Z in mm".
Result<std::vector<double>, std::string> numbers_of(std::string_view option, std::string_view text, std::size_t least,
                                                    std::size_t most, std::string_view what);

}  // namespace passo
