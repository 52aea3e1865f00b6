#include "arc_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

constexpr double turn = 2 * std::numbers::pi;

double angle_of(const ProgrammedArc& arc, const std::array<double, 3>& at) {
  return std::atan2(at[arc.second] - arc.centre[arc.second], at[arc.first] - arc.centre[arc.first]);
}

// A full circle if the arc ends where it began.
double sweep_of(const ProgrammedArc& arc) {
  if (arc.from[arc.first] == arc.to[arc.first] && arc.from[arc.second] == arc.to[arc.second]) return turn;
  const double angle = angle_of(arc, arc.to) - angle_of(arc, arc.from);
  double sweep = std::fmod(arc.counterclockwise ? angle : -angle, turn);
  if (sweep <= 0) sweep += turn;
  return sweep;
}

// The place at the fraction `share` of the arc. The radius changes in proportion, if its ends differ in it.
std::array<double, 3> place_at(const ProgrammedArc& arc, double sweep, double share) {
  if (share >= 1) return arc.to;
  const auto radius_of = [&](const std::array<double, 3>& at) {
    return std::hypot(at[arc.first] - arc.centre[arc.first], at[arc.second] - arc.centre[arc.second]);
  };
  const double radius = std::lerp(radius_of(arc.from), radius_of(arc.to), share);
  const double angle = angle_of(arc, arc.from) + (arc.counterclockwise ? sweep : -sweep) * share;
  const std::size_t third = 3 - arc.first - arc.second;
  std::array<double, 3> at{};
  at[arc.first] = arc.centre[arc.first] + radius * std::cos(angle);
  at[arc.second] = arc.centre[arc.second] + radius * std::sin(angle);
  at[third] = std::lerp(arc.from[third], arc.to[third], share);
  return at;
}

bool is_same_place(const ProgrammedArc& arc, const std::array<double, 3>& a, const std::array<double, 3>& b,
                   double digit) {
  return std::llround(a[arc.first] / digit) == std::llround(b[arc.first] / digit) &&
         std::llround(a[arc.second] / digit) == std::llround(b[arc.second] / digit);
}

}  // namespace

std::vector<ArcPart> arc_parts(const ProgrammedArc& arc, const ArcLimits& limits, double mm, double digit) {
  constexpr double tolerance_mm = 0.002;
  constexpr double most_lines = 100'000;
  const double radius =
      std::hypot(arc.from[arc.first] - arc.centre[arc.first], arc.from[arc.second] - arc.centre[arc.second]);
  const double sweep = sweep_of(arc);
  const double radius_mm = radius * mm;
  const bool is_flat = radius * (1 - std::cos(std::min(sweep, std::numbers::pi) / 2)) < digit / 2;
  if (is_flat) return {{arc.to, false}};
  const bool is_taken = radius_mm >= limits.least_radius && radius_mm <= limits.most_radius;
  double count = 1;
  if (is_taken) {
    constexpr double rounding = 1e-9;
    count = std::ceil(sweep / (limits.most_degrees * turn / 360) - rounding);
    // Ends that are written as one place would be a full circle.
    if (sweep < turn - rounding && is_same_place(arc, arc.from, arc.to, digit)) count = std::max(count, 2.0);
  } else {
    const double step = radius_mm > tolerance_mm ? 2 * std::acos(1 - tolerance_mm / radius_mm) : turn / 4;
    count = std::clamp(std::ceil(sweep / std::min(step, turn / 4)), 1.0, most_lines);
  }
  std::vector<ArcPart> parts;
  for (double i = 1; i <= count; ++i) parts.push_back({place_at(arc, sweep, i / count), is_taken});
  return parts;
}

}  // namespace passo
