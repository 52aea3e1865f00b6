#include "passo/geometry/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

constexpr double steepest_slope = 20;

}  // namespace

Cutter Cutter::ball(Mm diameter) {
  return {.radius = diameter / 2, .flat = Mm(0), .corner = diameter / 2, .half_angle = {}};
}

Cutter Cutter::flat_end(Mm diameter) {
  return {.radius = diameter / 2, .flat = diameter / 2, .corner = Mm(0), .half_angle = {}};
}

Cutter Cutter::bull_nose(Mm diameter, Mm corner) {
  return {.radius = diameter / 2, .flat = diameter / 2 - corner, .corner = corner, .half_angle = {}};
}

Cutter Cutter::vee(Mm diameter, Radians included_angle, Mm tip) {
  return {.radius = diameter / 2, .flat = tip / 2, .corner = Mm(0), .half_angle = {included_angle.value / 2}};
}

Cutter Cutter::tapered_ball(Mm diameter, Mm tip, Radians half_angle) {
  return {.radius = diameter / 2, .flat = Mm(0), .corner = tip / 2, .half_angle = half_angle};
}

Cutter::Kind Cutter::kind() const {
  if (half_angle.value > 0) return corner > Mm(0) ? Kind::tapered_ball : Kind::v;
  if (corner == Mm(0)) return Kind::flat;
  return flat == Mm(0) ? Kind::ball : Kind::bull_nose;
}

double Cutter::steepness() const {
  return 1 / std::tan(half_angle.value);
}

Mm Cutter::arc_end() const {
  return std::min(radius, flat + corner * std::cos(half_angle.value));
}

Mm Cutter::height(Mm distance) const {
  const double out = std::min(distance, radius).value() - flat.value();
  if (out <= 0) return Mm(0);
  const double arc = corner.value();
  const double end = arc_end().value() - flat.value();
  const double on_arc = std::min(out, end);
  const double up = arc - std::sqrt(std::max(0.0, arc * arc - on_arc * on_arc));
  const bool is_on_cone = half_angle.value > 0 && out > end;
  return Mm(is_on_cone ? up + (out - end) * steepness() : up);
}

double Cutter::slope(Mm distance) const {
  const double out = std::min(distance, steepest()).value() - flat.value();
  if (out <= 0) return 0;
  if (half_angle.value > 0 && out > arc_end().value() - flat.value()) return steepness();
  return out / std::sqrt(corner.value() * corner.value() - out * out);
}

Mm Cutter::steepest() const {
  const double least_angle = std::atan(1 / steepest_slope);
  if (half_angle.value >= least_angle || corner.value() == 0) return radius;
  return std::min(radius, Mm(flat.value() + corner.value() * std::cos(least_angle)));
}

Cutter Cutter::grown(Mm stock) const {
  return {.radius = radius + stock, .flat = flat, .corner = corner + stock, .half_angle = half_angle};
}

Mm Cutter::step_for_scallop(Mm scallop) const {
  const double h = scallop.value();
  if (h <= 0) return Mm(0);
  const double arc = std::min(corner, radius).value();
  const double arc_top = arc * (1 - std::sin(half_angle.value));
  const double half = h < arc_top ? std::sqrt(2 * arc * h - h * h)
                                  : (arc_end().value() - flat.value()) + (h - arc_top) * std::tan(half_angle.value);
  return std::min(flat + Mm(half), radius) * 2;
}

std::string flaw_of(const Cutter& cutter) {
  constexpr Mm least{0.005};
  constexpr Mm largest{250};
  constexpr double sharpest = 0.5 * std::numbers::pi / 180;  // between the flanks
  // Written so that a NaN is a flaw too.
  if (!(cutter.radius >= least)) return "a diameter of 0.01 mm or more";
  if (!(cutter.radius <= largest)) return "a diameter of at most 500 mm";
  const double between = 2 * cutter.half_angle.value;
  if (between != 0 && !(between >= sharpest && between <= std::numbers::pi - sharpest)) {
    return "an included angle from 0.5 to 179.5 degrees";
  }
  if (!(cutter.flat >= Mm(0))) return "a corner radius of at most half the diameter";
  const bool tip_is_narrow = cutter.flat <= cutter.radius && cutter.corner <= cutter.radius;
  if (!tip_is_narrow || (cutter.kind() == Cutter::Kind::v && cutter.flat == cutter.radius)) {
    return "a tip that is narrower than the cutter";
  }
  return "";
}

}  // namespace passo
