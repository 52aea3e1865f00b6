#include <algorithm>
#include <numbers>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "passo/base/read_double.hpp"
#include "passo/geometry/cutter.hpp"

namespace passo {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Shape {
  Cutter::Kind kind;
  std::string_view name;
  std::string_view form;
  std::size_t least;  // so many numbers
  std::size_t most;
};
constexpr Shape shapes[] = {{Cutter::Kind::ball, "ball", "ball:DIAMETER", 1, 1},
                            {Cutter::Kind::flat, "flat", "flat:DIAMETER", 1, 1},
                            {Cutter::Kind::bull_nose, "bull", "bull:DIAMETER:CORNER_RADIUS", 2, 2},
                            {Cutter::Kind::v, "vee", "vee:ANGLE:DIAMETER[:TIP]", 2, 3},
                            {Cutter::Kind::tapered_ball, "taper", "taper:TIP_DIAMETER:HALF_ANGLE:DIAMETER", 3, 3}};

// The numbers between colons; empty: one is none.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> values;
  while (true) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    double value = 0;
    const auto [end, error] = read_double(text.data(), text.data() + colon, value);
    if (error != std::errc() || end != text.data() + colon || !(value >= 0 && value <= 1000)) return {};
    values.push_back(value);
    if (colon == text.size()) return values;
    text.remove_prefix(colon + 1);
  }
}

Cutter cutter_from(Cutter::Kind kind, const std::vector<double>& n) {
  switch (kind) {
    case Cutter::Kind::ball: return Cutter::ball(Mm(n[0]));
    case Cutter::Kind::flat: return Cutter::flat_end(Mm(n[0]));
    case Cutter::Kind::bull_nose: return Cutter::bull_nose(Mm(n[0]), Mm(n[1]));
    case Cutter::Kind::v: return Cutter::vee(Mm(n[1]), {n[0] * degree}, Mm(n.size() > 2 ? n[2] : 0));
    case Cutter::Kind::tapered_ball: return Cutter::tapered_ball(Mm(n[2]), Mm(n[0]), {n[1] * degree});
  }
  return {};
}

}  // namespace

std::string_view name_of(Cutter::Kind kind) {
  for (const Shape& shape : shapes) {
    if (shape.kind == kind) return shape.name;
  }
  return "";
}

std::optional<Cutter::Kind> cutter_kind_of(std::string_view name) {
  for (const Shape& shape : shapes) {
    if (shape.name == name) return shape.kind;
  }
  return std::nullopt;
}

Result<Cutter, std::string> parse_cutter(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view name = text.substr(0, colon);
  const Shape* const shape = std::find_if(std::begin(shapes), std::end(shapes),
                                          [&](const Shape& candidate) { return candidate.name == name; });
  if (shape == std::end(shapes)) {
    return Failure{fmt::format(
        "'{}' is not a valid cutter; expected e.g. ball:3, flat:6, bull:6:1, vee:60:6 or taper:1:5:6", text)};
  }
  const std::vector<double> n = colon == text.size() ? std::vector<double>() : numbers_of(text.substr(colon + 1));
  if (n.size() < shape->least || n.size() > shape->most) {
    return Failure{fmt::format("'{}': expected {}, lengths in mm, angles in degrees", text, shape->form)};
  }
  const bool is_vee = shape->kind == Cutter::Kind::v;
  const double angle = is_vee ? n[0] : shape->kind == Cutter::Kind::tapered_ball ? n[1] : 60;
  if (angle < 1 || angle > (is_vee ? 178 : 89)) {
    return Failure{fmt::format("'{}': expected an angle from 1 to {} degrees", text, is_vee ? 178 : 89)};
  }
  const Cutter cutter = cutter_from(shape->kind, n);
  if (const std::string flaw = flaw_of(cutter); !flaw.empty()) {
    return Failure{fmt::format("'{}': expected {}", text, flaw)};
  }
  return cutter;
}

std::string describe(const Cutter& cutter) {
  const double diameter = cutter.radius.value() * 2;
  const double angle = cutter.half_angle.value / degree;
  switch (cutter.kind()) {
    case Cutter::Kind::flat: return fmt::format("flat end, {:g} mm", diameter);
    case Cutter::Kind::ball: return fmt::format("ball nose, {:g} mm", diameter);
    case Cutter::Kind::bull_nose:
      return fmt::format("bull nose, {:g} mm, corner {:g} mm", diameter, cutter.corner.value());
    case Cutter::Kind::v: {
      const std::string tip = cutter.flat.value() > 0 ? fmt::format(", tip {:g} mm", cutter.flat.value() * 2) : "";
      return fmt::format("V of {:g} degrees, {:g} mm{}", angle * 2, diameter, tip);
    }
    case Cutter::Kind::tapered_ball: break;
  }
  return fmt::format("tapered ball, {:g} mm at the tip, {:g} degrees per side, {:g} mm", cutter.corner.value() * 2,
                     angle, diameter);
}

}  // namespace passo
