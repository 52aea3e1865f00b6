// read_airfoil: reads the section of a wing from a coordinate file (.dat) as a closed path.
//
// Two formats are supported: Selig's, from the trailing edge over the upper side to the nose and back along the lower
// side; and Lednicer's, with the numbers of points in the second line, and both sides starting at the nose. The section
// is a smooth curve through the points, which meets at the trailing edge in a corner, or the polygon of the points. It
// is scaled to the chord length; the origin stays as in the file, usually at the nose.
//
// Invalid input produces diagnostics "airfoil.…" with a line number.
//
// Source: UIUC Airfoil Coordinates Database, M. Selig.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

enum class AirfoilCurve : std::uint8_t { spline, lines };

Drawing read_airfoil(const std::string& name, std::string_view text, Mm chord, Diagnostics& diagnostics,
                     AirfoilCurve curve = AirfoilCurve::spline);

// Returns whether the text looks like a coordinate file: its first lines contain lines of two numbers.
bool looks_like_airfoil(std::string_view text);

}  // namespace passo
