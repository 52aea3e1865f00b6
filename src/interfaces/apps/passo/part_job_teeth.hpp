// Where the teeth of a thread mill enter the stock beside the boss that gets the thread.
//
// In the stock, a thread mill cuts with its neck only (decision 0194). Around a boss, the outer side of the teeth runs
// under the surface of whatever stands too near: a wall, another boss or a floor that is too high. This check looks at
// the stock under the teeth, except on the side of the boss.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/geometry/curve.hpp"
#include "passo/geometry/tool_shape.hpp"
#include "passo/geometry/vector3.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

// The deepest place.
struct TeethHit {
  double depth = 0;  // of the tip below the surface of the stock, mm
  Vector3 place{};   // on the surface
  std::uint32_t line = 0;
  Vector3 axis{};    // of the boss
  double reach = 0;  // of the teeth from the axis, mm
};

// Collects the feeds around one boss, between two rapids.
class TeethWay {
 public:
  bool empty() const { return points_.empty(); }
  std::size_t tool() const { return tool_; }
  void add(const Curve& curve, const Vector3& zero, std::uint32_t line, std::size_t tool, const ToolShape& shape);
  // Judges the feeds that were added, and forgets them. `field`: the stock before them.
  std::optional<TeethHit> take_hit(const HeightField& field, const ToolShape& shape);

 private:
  struct Sample {
    Vector3 at;
    std::uint32_t line = 0;
  };
  // Without a helix there is no boss.
  struct Boss {
    Vector3 axis{};
    double inside = 0;  // nearer to the axis than this, the stock is the boss, which the teeth or the neck may cut
  };
  Boss boss(const ToolShape& shape) const;

  std::size_t tool_ = 0;
  std::vector<Sample> points_;
  std::optional<Vector3> axis_;
  double nearest_ = 0;  // of the cutter's centre on a helix, from the axis
};

}  // namespace passo
