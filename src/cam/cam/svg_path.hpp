// The data of an SVG path as rows of lines, arcs and Bézier curves in the path's own coordinates. Private to cam/.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct SvgSpot {
  double x = 0;
  double y = 0;
};

// An arc of an ellipse: the places centre + major cos a + minor sin a, for a from `start` on by `sweep`.
struct SvgArc {
  SvgSpot centre = {};
  SvgSpot major = {};
  SvgSpot minor = {};
  double start = 0;
  double sweep = 0;

  SvgSpot at(double angle) const;
};

// A piece of a path from the end of the one before. A line has no control points, a quadratic curve one, a cubic two.
struct SvgPiece {
  SvgSpot end = {};
  std::vector<SvgSpot> control = {};
  std::optional<SvgArc> arc = {};
};

struct SvgSubpath {
  SvgSpot start = {};
  std::vector<SvgPiece> pieces = {};
  bool is_closed = false;
};

struct SvgPathFlaw {
  std::size_t place = 0;  // in the data
  std::string expected = {};
};

// The rows of a path's data, or where the data is wrong. `most`: pieces; more are a flaw.
std::optional<SvgPathFlaw> read_svg_path(std::string_view data, std::size_t most, std::vector<SvgSubpath>& subpaths);

}  // namespace passo
