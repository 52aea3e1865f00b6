// ToolShape: a milling cutter as a body that turns about Z. Its underside is given by its height above the tip at each
// distance from the axis.
//
// All shapes are convex: the underside rises with the distance, and ever more steeply. What sweeps such a tool relies
// on that. Above its radius the tool goes up without end; the holder is a wider cylinder above the cutter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "passo/units/units.hpp"

namespace passo {

struct ToolShape {
  enum class Kind : std::uint8_t {
    flat,          // an end mill
    ball,          // its tip is half a ball
    v,             // a cone, perhaps with a flat tip
    bull_nose,     // an end mill with round corners
    tapered_ball,  // a cone with a ball for a tip
  };
  Kind kind = Kind::flat;
  Mm radius{1.5};
  Mm tip_radius{0};                          // v: of its flat tip; bull_nose: of its corners; tapered_ball: of the ball
  double half_angle = std::numbers::pi / 6;  // v, tapered_ball: between the axis and the cone, radians
  Mm flute_length{0};                        // how high above the tip it cuts; 0: not known
  Mm holder_radius{0};                       // 0: not known
  Mm holder_from{0};                         // the height above the tip where the holder begins

  // How steeply a cone rises: height for distance.
  double steepness() const { return 1 / std::tan(half_angle); }
  // tapered_ball: the distance from the axis where the ball meets the cone.
  Mm tangent_radius() const { return std::min(radius, tip_radius * std::cos(half_angle)); }
  // The height of the underside above the tip at this distance from the axis, up to the radius.
  Mm height_at(Mm distance) const;
};

// "flat", "ball", "vee", "bull", "taper".
std::string_view name_of(ToolShape::Kind kind);
std::optional<ToolShape::Kind> tool_kind_of(std::string_view name);
// All names, for messages.
inline constexpr const char* tool_kind_names = "flat, ball, bull, vee or taper";

// Why there is no such tool, in words for the user who asked for it. Empty: there is.
std::string flaw_of(const ToolShape& tool);

}  // namespace passo
