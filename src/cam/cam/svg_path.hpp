// Reads the data of an SVG path as sequences of lines, arcs and Bézier curves in the path's own coordinates. Private to
// cam/.
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

// An elliptical arc: the points centre + major cos a + minor sin a, with a from `start` to `start` + `sweep`.
struct SvgArc {
  SvgSpot centre = {};
  SvgSpot major = {};
  SvgSpot minor = {};
  double start = 0;
  double sweep = 0;

  SvgSpot at(double angle) const;
};

// A piece of a path, starting at the end of the previous one. A line has no control points, a quadratic curve one, a
// cubic curve two.
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
  std::size_t place = 0;  // offset in the data
  std::string expected = {};
};

// Reads the subpaths of a path; returns the position of the first error, if any. `most`: maximum number of pieces; more
// are an error.
std::optional<SvgPathFlaw> read_svg_path(std::string_view data, std::size_t most, std::vector<SvgSubpath>& subpaths);

}  // namespace passo
