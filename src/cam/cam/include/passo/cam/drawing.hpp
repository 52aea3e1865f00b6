// Drawing: the geometry that every reader of cam/ makes of its file: holes and paths on named layers.
//
// Lengths are whole nanometres, X to the right, Y up. So an inch and a millimetre are both exact, and no sum of lengths
// rounds. A coordinate is at most 100 m from zero. A path is a row of points; from each point a line or an arc leads to
// the next. The readers refuse a drawing of more than `most_drawn` points.
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
inline constexpr std::size_t most_drawn = 4'000'000;  // points, those of holes included

constexpr Mm to_mm(Nanometres length) {
  return Mm(static_cast<double>(length.count) / nanometres_per_mm);
}
// Rounds to the nearest nanometre. The length is at most 10^9 mm.
inline Nanometres to_nanometres(Mm length) {
  return {std::llround(length.value() * nanometres_per_mm)};
}

struct DrawnPoint {
  Nanometres x;
  Nanometres y;
  friend constexpr auto operator<=>(const DrawnPoint&, const DrawnPoint&) = default;  // NOLINT(modernize-use-nullptr)
};

inline double distance_nm(DrawnPoint a, DrawnPoint b) {
  // No place is so far that its square were too much for a double: std::hypot() would take four times as long.
  const auto across = static_cast<double>(a.x.count - b.x.count);
  const auto up = static_cast<double>(a.y.count - b.y.count);
  return std::sqrt(across * across + up * up);
}

struct DrawnHole {
  DrawnPoint at = {};
  Nanometres diameter = {};  // 0: the file does not say
  std::uint32_t layer = 0;   // index into Drawing::layers
  std::uint32_t line = 0;    // of the file, from 1; 0: the file has no lines
};

// A point of a path. `bulge` tells how the path leads to the next point: 0 by a line, else by an arc, as the tangent of
// a quarter of the angle that the arc sweeps; above 0 counterclockwise. 1 is a half circle.
struct PathPoint {
  DrawnPoint at = {};
  double bulge = 0;
};

struct DrawnPath {
  std::vector<PathPoint> points = {};
  bool is_closed = false;
  // How wide the path is to be cut: a slot or a rout of a drill file. 0: a mere line of a drawing.
  Nanometres width = {};
  std::uint32_t layer = 0;
  std::uint32_t line = 0;
};

struct Drawing {
  std::string file = {};                 // as the user named it
  std::vector<std::string> layers = {};  // of a drill file: its tools, "T1"
  std::vector<DrawnHole> holes = {};
  std::vector<DrawnPath> paths = {};
  std::vector<std::string> notes = {};  // what was guessed or left out, a sentence each without a full stop
};

// The least X and the least Y of all holes' centres and of all points of slots; zero if there are none.
DrawnPoint lower_left_of(const std::vector<Drawing>& drawings);
// Makes `zero` the drawing's zero.
void move_zero_to(DrawnPoint zero, Drawing& drawing);

}  // namespace passo
