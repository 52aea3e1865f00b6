#include "passo/carve/cutter.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double steepest_slope = 20;
constexpr double degree = std::numbers::pi / 180;

// Where the arc ends: at the cone, or upright.
double end_of_arc(const Cutter& cutter) {
  return cutter.flat.value() + cutter.corner.value() * std::cos(cutter.half_angle.value);
}

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

Mm Cutter::height(Mm distance) const {
  const double out = std::min(distance, radius).value() - flat.value();
  if (out <= 0) return Mm(0);
  const double arc = corner.value();
  const double end = end_of_arc(*this) - flat.value();
  const double on_arc = std::min(out, end);
  const double up = arc - std::sqrt(std::max(0.0, arc * arc - on_arc * on_arc));
  return Mm(out <= end ? up : up + (out - end) / std::tan(half_angle.value));
}

double Cutter::slope(Mm distance) const {
  const double out = std::min(distance, steepest()).value() - flat.value();
  if (out <= 0) return 0;
  if (out > end_of_arc(*this) - flat.value()) return 1 / std::tan(half_angle.value);
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
                                  : (end_of_arc(*this) - flat.value()) + (h - arc_top) * std::tan(half_angle.value);
  return std::min(flat + Mm(half), radius) * 2;
}

namespace {

struct Shape {
  std::string_view name;
  std::string_view form;
  std::size_t least;
  std::size_t most;
};
constexpr Shape shapes[] = {{"ball", "ball:DIAMETER", 1, 1},
                            {"flat", "flat:DIAMETER", 1, 1},
                            {"bull", "bull:DIAMETER:CORNER_RADIUS", 2, 2},
                            {"vee", "vee:ANGLE:DIAMETER[:TIP]", 2, 3},
                            {"taper", "taper:TIP_DIAMETER:HALF_ANGLE:DIAMETER", 3, 3}};

// The numbers between colons; empty: one is none.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + colon, value);
    if (error != std::errc() || end != text.data() + colon || !(value >= 0 && value <= 1000)) return {};
    values.push_back(value);
    if (colon == text.size()) return values;
    text.remove_prefix(colon + 1);
  }
}

std::string fault_of(const Cutter& cutter) {
  if (cutter.radius.value() < 0.005) return "a diameter of 0.01 mm or more";
  if (cutter.radius.value() > 100) return "a diameter of at most 200 mm";
  if (cutter.flat.value() < 0) return "a corner radius of at most half the diameter";
  if (cutter.flat > cutter.radius || cutter.corner > cutter.radius) return "a tip that is narrower than the cutter";
  return "";
}

}  // namespace

Result<Cutter, std::string> parse_cutter(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view name = text.substr(0, colon);
  const Shape* const shape = std::find_if(std::begin(shapes), std::end(shapes),
                                          [&](const Shape& candidate) { return candidate.name == name; });
  if (shape == std::end(shapes)) {
    return Failure{fmt::format("'{}' is no cutter; expected ball:3, flat:6, bull:6:1, vee:60:6 or taper:1:5:6", text)};
  }
  const std::vector<double> n = colon == text.size() ? std::vector<double>() : numbers_of(text.substr(colon + 1));
  if (n.size() < shape->least || n.size() > shape->most) {
    return Failure{fmt::format("'{}': expected {}, lengths in mm, angles in degrees", text, shape->form)};
  }
  const bool is_vee = name == "vee";
  const double angle = is_vee ? n[0] : name == "taper" ? n[1] : 60;
  if (angle < 1 || angle > (is_vee ? 178 : 89)) {
    return Failure{fmt::format("'{}': expected an angle from 1 to {} degrees", text, is_vee ? 178 : 89)};
  }
  Cutter cutter;
  if (name == "ball") cutter = Cutter::ball(Mm(n[0]));
  if (name == "flat") cutter = Cutter::flat_end(Mm(n[0]));
  if (name == "bull") cutter = Cutter::bull_nose(Mm(n[0]), Mm(n[1]));
  if (is_vee) cutter = Cutter::vee(Mm(n[1]), {angle * degree}, Mm(n.size() > 2 ? n[2] : 0));
  if (name == "taper") cutter = Cutter::tapered_ball(Mm(n[2]), Mm(n[0]), {angle * degree});
  if (const std::string fault = fault_of(cutter); !fault.empty()) {
    return Failure{fmt::format("'{}': expected {}", text, fault)};
  }
  return cutter;
}

std::string describe(const Cutter& cutter) {
  const double diameter = cutter.radius.value() * 2;
  const double angle = cutter.half_angle.value / degree;
  if (angle > 0 && cutter.corner.value() > 0) {
    return fmt::format("tapered ball, {:g} mm at the tip, {:g} degrees a side, {:g} mm", cutter.corner.value() * 2,
                       angle, diameter);
  }
  if (angle > 0) {
    const std::string tip = cutter.flat.value() > 0 ? fmt::format(", tip {:g} mm", cutter.flat.value() * 2) : "";
    return fmt::format("V of {:g} degrees, {:g} mm{}", angle * 2, diameter, tip);
  }
  if (cutter.corner.value() == 0) return fmt::format("flat end, {:g} mm", diameter);
  if (cutter.flat.value() == 0) return fmt::format("ball nose, {:g} mm", diameter);
  return fmt::format("bull nose, {:g} mm, corner {:g} mm", diameter, cutter.corner.value());
}

}  // namespace passo
