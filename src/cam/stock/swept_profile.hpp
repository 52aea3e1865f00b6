// SweptProfile: finds where the underside of a tool moving straight down a slope is lowest above a point. Private to
// stock/.
//
// The path runs along u and descends by `slope` per millimetre (slope >= 0); v is the coordinate across it. With the
// tip at s, the underside above the point (u, v) is at z(s) + h(d), d² = (u - s)² + v². h is convex and increasing, so
// the sum is convex in s and has a single minimum: reach(v) is the tip's distance beyond u at that minimum. Within a
// segment the minimum is at that position or at the nearest end of the segment. So no cell needs a search, and the
// computation is plain arithmetic on vector lanes.
//
// With w = s - u, the minimum is where h'(d) w / d = slope:
//   ball of radius r:      w = sqrt(r² - v²) slope / sqrt(1 + slope²), the slanted cylinder
//   cone that rises by m:  w = |v| slope / sqrt(m² - slope²); where slope >= m, as far as the tool's rim reaches
//   flat tip of radius r:  w = sqrt(r² - v²), its edge
//   round corner (a ring): an equation of fourth degree; Newton from above, which a convex function cannot overshoot
// Any w gives a height that the tool actually reaches: an error of w only leaves material, proportional to its square.
#pragma once

#include <algorithm>
#include <cmath>

#include "passo/geometry/cutter.hpp"

namespace passo {

inline float above_zero(float value) {
  return value > 0 ? value : 0;
}

struct FlatProfile {
  float radius2;
  float edge;  // 1 on a slope, 0 if level

  FlatProfile(float radius, float slope) : radius2(radius * radius), edge(slope > 0 ? 1.0F : 0.0F) {}
  float reach(float v2) const { return edge * std::sqrt(above_zero(radius2 - v2)); }
  float height(float) const { return 0; }
};

struct BallProfile {
  float radius;
  float radius2;
  float lean;

  BallProfile(float ball, float slope)
      : radius(ball), radius2(ball * ball), lean(slope / std::sqrt(1 + slope * slope)) {}
  float reach(float v2) const { return lean * std::sqrt(above_zero(radius2 - v2)); }
  float height(float d2) const { return radius - std::sqrt(above_zero(radius2 - d2)); }
};

// Returns the ratio of w to |v| for a cone that rises by `steepness`.
inline float cone_lean(float steepness, float slope) {
  constexpr float to_the_rim = 1e6F;
  return slope < steepness ? std::min(to_the_rim, slope / std::sqrt(steepness * steepness - slope * slope))
                           : to_the_rim;
}

struct ConeProfile {
  float tip;
  float tip2;
  float rim2;
  float steepness;
  float lean;
  float edge;
  float least;  // 1: always at the rim

  ConeProfile(float tip_radius, float rim, float rise, float slope)
      : tip(tip_radius),
        tip2(tip_radius * tip_radius),
        rim2(rim * rim),
        steepness(rise),
        lean(cone_lean(rise, slope)),
        edge(slope > 0 ? 1.0F : 0.0F),
        least(slope < rise ? 0.0F : 1.0F) {}
  float reach(float v2) const {
    const float rim = std::sqrt(above_zero(rim2 - v2));
    const float cone = std::max(lean * std::sqrt(v2), least * rim);
    const float of_tip = edge * std::sqrt(above_zero(tip2 - v2));
    return std::min(rim, std::max(cone, of_tip));
  }
  float height(float d2) const { return steepness * above_zero(std::sqrt(d2) - tip); }
};

struct TaperedProfile {
  float ball;
  float ball2;
  float tangent;
  float tangent2;
  float tangent_height;
  float rim2;
  float steepness;
  float lean;
  float cone;
  float least;

  TaperedProfile(float tip_radius, float where, float rim, float rise, float slope)
      : ball(tip_radius),
        ball2(tip_radius * tip_radius),
        tangent(where),
        tangent2(where * where),
        tangent_height(tip_radius - std::sqrt(above_zero(tip_radius * tip_radius - where * where))),
        rim2(rim * rim),
        steepness(rise),
        lean(slope / std::sqrt(1 + slope * slope)),
        cone(cone_lean(rise, slope)),
        least(slope < rise ? 0.0F : 1.0F) {}
  float reach(float v2) const {
    const float rim = std::sqrt(above_zero(rim2 - v2));
    const float of_ball = lean * std::sqrt(above_zero(ball2 - v2));
    const float of_cone = std::max(cone * std::sqrt(v2), least * rim);
    return std::min(rim, v2 + of_ball * of_ball <= tangent2 ? of_ball : of_cone);
  }
  float height(float d2) const {
    const float on_ball = ball - std::sqrt(above_zero(ball2 - d2));
    const float on_cone = tangent_height + steepness * (std::sqrt(d2) - tangent);
    return d2 <= tangent2 ? on_ball : on_cone;
  }
};

struct RingProfile {
  // The minimum slope; flatter ones are solved with this slope, so that a solution exists and floats can resolve it.
  static constexpr float flattest = 0.001F;
  // The lowest height is then accurate to 0.3 um per mm of the rim's radius.
  static constexpr int steps = 2;

  float corner;
  float corner2;
  float inner;  // radius of the ring: from the axis to the centre of the corner
  float slope2;
  float steep;  // sqrt(1 + slope²)
  float flat;   // inner * steep
  float pull;   // corner * slope
  float below;  // 1 / (flat + pull)
  float above;  // 1 / pull
  float edge;

  RingProfile(float corner_radius, float rim, float slope)
      : corner(corner_radius),
        corner2(corner_radius * corner_radius),
        inner(rim - corner_radius),
        slope2(std::max(slope, flattest) * std::max(slope, flattest)),
        steep(std::sqrt(1 + slope2)),
        flat(inner * steep),
        pull(corner_radius * std::max(slope, flattest)),
        below(1 / (flat + pull)),
        above(1 / pull),
        edge(slope > 0 ? 1.0F : 0.0F) {}

  // The contact is at the angle t from the direction of travel. With sin t = steep q / sqrt(1 + q²), |v| = flat q /
  // sqrt(1 + q²) + pull q, which is concave in q. Uses Halley's method, starting from a value that is nowhere too
  // large.
  float reach(float v2) const {
    const float v = std::sqrt(v2);
    float q = std::max(v * below, (v - flat) * above);
    for (int i = 0; i < steps; ++i) {
      const float inverse2 = 1 / (1 + q * q);
      const float round = flat * std::sqrt(inverse2);
      const float too_far = q * (round + pull) - v;
      const float rise = round * inverse2 + pull;
      const float bend = 1.5F * q * round * inverse2 * inverse2;
      q = above_zero(q - too_far * rise / (rise * rise + too_far * bend));
    }
    const float inverse2 = 1 / (1 + q * q);
    const float cosine2 = above_zero((1 - slope2 * q * q) * inverse2);
    return edge * (inner * std::sqrt(cosine2) + pull * std::sqrt(cosine2 / inverse2) / steep);
  }
  float height(float d2) const {
    const float out = above_zero(std::sqrt(d2) - inner);
    return corner - std::sqrt(above_zero(corner2 - out * out));
  }
};

// Calls `use` with the profile of the cutter. `slope`: descent per millimetre of the path in X Y.
template <class Use>
void with_profile(const Cutter& cutter, float slope, Use&& use) {
  const auto number = [](Mm length) { return static_cast<float>(length.value()); };
  const auto rise = [&] { return static_cast<float>(cutter.steepness()); };
  const float rim = number(cutter.radius);
  switch (cutter.kind()) {
    case Cutter::Kind::flat: return use(FlatProfile(rim, slope));
    case Cutter::Kind::ball: return use(BallProfile(rim, slope));
    case Cutter::Kind::v: return use(ConeProfile(number(cutter.flat), rim, rise(), slope));
    case Cutter::Kind::bull_nose: return use(RingProfile(number(cutter.corner), rim, slope));
    case Cutter::Kind::tapered_ball:
      return use(TaperedProfile(number(cutter.corner), number(cutter.arc_end()), rim, rise(), slope));
  }
}

}  // namespace passo
