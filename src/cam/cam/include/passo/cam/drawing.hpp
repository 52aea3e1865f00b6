// Drawing: the common geometry that all readers of cam/ produce: holes and paths on named layers.
//
// Lengths are whole nanometres, X to the right, Y up. Inches and millimetres are therefore both exact, and adding
// lengths involves no rounding. Coordinates are limited to 100 m. A path is a sequence of points, joined by lines or
// arcs. The readers refuse a drawing of more than `most_drawn` points.
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

struct Nanometres {
  std::int64_t count = 0;
  friend constexpr Nanometres operator+(Nanometres a, Nanometres b) { return {a.count + b.count}; }
  friend constexpr Nanometres operator-(Nanometres a, Nanometres b) { return {a.count - b.count}; }
  friend constexpr auto operator<=>(Nanometres a, Nanometres b) = default;  // NOLINT(modernize-use-nullptr): no zero
};

inline constexpr double nanometres_per_mm = 1e6;
inline constexpr Nanometres farthest_drawn{100'000'000'000};
inline constexpr std::size_t most_drawn = 4'000'000;  // maximum number of points, including holes

constexpr Mm to_mm(Nanometres length) {
  return Mm(static_cast<double>(length.count) / nanometres_per_mm);
}
// Rounds to the nearest nanometre. The length must not exceed 10^9 mm.
inline Nanometres to_nanometres(Mm length) {
  return {std::llround(length.value() * nanometres_per_mm)};
}

struct DrawnPoint {
  Nanometres x;
  Nanometres y;
  friend constexpr auto operator<=>(const DrawnPoint&, const DrawnPoint&) = default;  // NOLINT(modernize-use-nullptr)
};

inline double distance_nm(DrawnPoint a, DrawnPoint b) {
  // The square of a coordinate always fits in a double; std::hypot(), which avoids overflow, would take four times as
  // long.
  const auto across = static_cast<double>(a.x.count - b.x.count);
  const auto up = static_cast<double>(a.y.count - b.y.count);
  return std::sqrt(across * across + up * up);
}

struct DrawnHole {
  DrawnPoint at = {};
  Nanometres diameter = {};  // 0: not stated in the file, or a dot of a pen
  std::uint32_t layer = 0;   // index into Drawing::layers
  std::uint32_t line = 0;    // line of the file, from 1; 0: the file has no lines
};

// A point of a path. `bulge` defines the connection to the next point: 0 is a line; otherwise it is an arc, and the
// bulge is the tangent of a quarter of its sweep angle, positive if counterclockwise. 1 is a half circle.
struct PathPoint {
  DrawnPoint at = {};
  double bulge = 0;
};

struct DrawnPath {
  std::vector<PathPoint> points = {};
  bool is_closed = false;
  // Width of a slot or rout in a drill file. 0: a line without a width.
  Nanometres width = {};
  std::uint32_t layer = 0;
  std::uint32_t line = 0;
};

struct Drawing {
  std::string file = {};                 // the file name given by the user
  std::vector<std::string> layers = {};  // in a drill file: its tools, e.g. "T1"
  std::vector<DrawnHole> holes = {};
  std::vector<DrawnPath> paths = {};
  std::vector<std::string> notes = {};  // guesses and omissions, each a sentence without a full stop
};

// Returns the minimum X and the minimum Y of all hole centres and slot points; the origin if there are none.
DrawnPoint lower_left_of(const std::vector<Drawing>& drawings);
// Moves the origin of the drawing to `zero`.
void move_zero_to(DrawnPoint zero, Drawing& drawing);

}  // namespace passo
