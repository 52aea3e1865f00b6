#include "passo/geometry/tool_shape.hpp"

#include <array>
#include <utility>

namespace passo {
namespace {

constexpr std::array<std::pair<ToolShape::Kind, std::string_view>, 5> kinds = {
    {{ToolShape::Kind::flat, "flat"},
     {ToolShape::Kind::ball, "ball"},
     {ToolShape::Kind::v, "vee"},
     {ToolShape::Kind::bull_nose, "bull"},
     {ToolShape::Kind::tapered_ball, "taper"}}};

// The height of a ball's underside above its lowest point.
double above_tip_of_ball(double radius, double distance) {
  return radius - std::sqrt(std::max(0.0, radius * radius - distance * distance));
}

}  // namespace

Mm ToolShape::height_at(Mm distance) const {
  const double d = distance.value();
  const double tip = tip_radius.value();
  switch (kind) {
    case Kind::flat: return Mm(0);
    case Kind::ball: return Mm(above_tip_of_ball(radius.value(), d));
    case Kind::v: return Mm(steepness() * std::max(0.0, d - tip));
    case Kind::bull_nose: return Mm(above_tip_of_ball(tip, std::max(0.0, d - (radius.value() - tip))));
    case Kind::tapered_ball: {
      const double tangent = tangent_radius().value();
      if (d <= tangent) return Mm(above_tip_of_ball(tip, d));
      return Mm(above_tip_of_ball(tip, tangent) + steepness() * (d - tangent));
    }
  }
  return Mm(0);
}

std::string_view name_of(ToolShape::Kind kind) {
  for (const auto& [which, name] : kinds) {
    if (which == kind) return name;
  }
  return "";
}

std::optional<ToolShape::Kind> tool_kind_of(std::string_view name) {
  for (const auto& [kind, word] : kinds) {
    if (word == name) return kind;
  }
  return std::nullopt;
}

std::string flaw_of(const ToolShape& tool) {
  constexpr Mm largest{250};
  constexpr double sharpest = 0.5;  // degrees
  const auto degrees = tool.half_angle * 360 / std::numbers::pi;
  if (!(tool.radius > Mm(0) && tool.radius <= largest)) return "its diameter must be above 0, and 500 mm at most";
  const bool is_cone = tool.kind == ToolShape::Kind::v || tool.kind == ToolShape::Kind::tapered_ball;
  if (is_cone && !(degrees >= sharpest && degrees <= 180 - sharpest))
    return "its angle must be from 0.5 to 179.5 degrees";
  switch (tool.kind) {
    case ToolShape::Kind::flat:
    case ToolShape::Kind::ball: break;
    case ToolShape::Kind::v:
      if (!(tool.tip_radius >= Mm(0) && tool.tip_radius < tool.radius)) return "its tip must be thinner than itself";
      break;
    case ToolShape::Kind::bull_nose:
      if (!(tool.tip_radius > Mm(0) && tool.tip_radius < tool.radius)) {
        return "the radius of its corners must be above 0, and less than its own";
      }
      break;
    case ToolShape::Kind::tapered_ball:
      if (!(tool.tip_radius > Mm(0) && tool.tip_radius <= tool.radius)) return "its ball must be no wider than itself";
      break;
  }
  if (tool.holder_radius > Mm(0) && !(tool.holder_from > Mm(0))) return "its holder must begin above the tip";
  return "";
}

}  // namespace passo
