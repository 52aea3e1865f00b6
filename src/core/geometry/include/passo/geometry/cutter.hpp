// Cutter: the shape of a cutter that turns: its height above its tip at each distance from its axis.
//
// One formula covers all shapes, from the axis outwards: a flat disc, an arc, a cone up to the radius. Outside the
// radius the cutter is a vertical wall. The shape is convex: the underside rises with the distance, and ever more
// steeply. What drops or sweeps such a cutter relies on that. What is above the cutting edges (shank, holder) is no
// part of it: see ToolShape.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Cutter {
  enum class Kind : std::uint8_t {
    flat,          // an end mill
    ball,          // its tip is half a ball
    v,             // a cone, perhaps with a flat tip
    bull_nose,     // an end mill with round corners
    tapered_ball,  // a cone with a ball for a tip
  };

  Mm radius{1.5};
  Mm flat{0};            // radius of the disc at the tip
  Mm corner{1.5};        // radius of the arc; 0: none
  Radians half_angle{};  // of the cone, from the axis; 0: the arc ends upright

  static Cutter ball(Mm diameter);
  static Cutter flat_end(Mm diameter);
  static Cutter bull_nose(Mm diameter, Mm corner);
  // `tip`: diameter of the flat at the tip.
  static Cutter vee(Mm diameter, Radians included_angle, Mm tip);
  // `half_angle`: between axis and flank; the ball at the tip has the diameter `tip`.
  static Cutter tapered_ball(Mm diameter, Mm tip, Radians half_angle);

  // Which of the five it is. What grown() returns may be none of them.
  Kind kind() const;
  // The height above the tip of the shape at a distance from the axis, which is at most the radius.
  Mm height(Mm distance) const;
  // The slope there, the height's derivative. At most 20: where the arc is steeper, the slope of a lesser distance.
  double slope(Mm distance) const;
  // The farthest distance at which slope() is exact.
  Mm steepest() const;
  // How steeply the cone rises: height for distance. Only of a cutter with a cone.
  double steepness() const;
  // The distance from the axis where the arc ends: at the cone, or upright. At most the radius.
  Mm arc_end() const;
  // The shape of all points that are within `stock` of this one. The tip of it lies lower by `stock`.
  Cutter grown(Mm stock) const;
  // The distance between two rows at which ridges of this height stay on a flat. 0: none do, as of a flat end.
  Mm step_for_scallop(Mm height) const;
};

// Why a cutter is invalid: the expected value in words, e.g. "a diameter of 0.01 mm or more". Empty: there is.
std::string flaw_of(const Cutter& cutter);

// "flat", "ball", "vee", "bull", "taper".
std::string_view name_of(Cutter::Kind kind);
std::optional<Cutter::Kind> cutter_kind_of(std::string_view name);
// All names, for messages.
inline constexpr const char* cutter_kind_names = "flat, ball, bull, vee or taper";

// Reads "ball:3", "flat:6", "bull:6:1" (corner radius), "vee:60:6", "vee:60:6:0.2" (included angle in degrees,
// diameter, tip) and "taper:1:5:6" (diameter of the ball, half angle in degrees, diameter). Lengths are mm. The failure
// is a message.
Result<Cutter, std::string> parse_cutter(std::string_view text);

// "ball nose, 3 mm"; for comments and summaries.
std::string describe(const Cutter& cutter);

}  // namespace passo
