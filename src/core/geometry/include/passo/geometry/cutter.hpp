// Cutter: the shape of a rotating cutter, given by the height above its tip at each distance from its axis.
//
// One formula covers all shapes, from the axis outwards: a flat disc, an arc, a cone up to the radius. At the radius
// the cutter has a vertical wall. The shape is convex: the underside rises with the distance, with increasing slope.
// Drop-cutter and sweep algorithms rely on that. The part above the cutting edges (shank, holder) is not included: see
// ToolShape.
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
  Radians half_angle{};  // of the cone, from the axis; 0: the arc ends vertically

  static Cutter ball(Mm diameter);
  static Cutter flat_end(Mm diameter);
  static Cutter bull_nose(Mm diameter, Mm corner);
  // Returns a V-bit; `tip` is the diameter of the flat at the tip.
  static Cutter vee(Mm diameter, Radians included_angle, Mm tip);
  // Returns a tapered ball; `half_angle` is the angle between axis and flank, `tip` the diameter of the ball at the
  // tip.
  static Cutter tapered_ball(Mm diameter, Mm tip, Radians half_angle);

  // Returns which of the five kinds it is. The result of grown() may be none of them.
  Kind kind() const;
  // Returns the height above the tip at a distance from the axis, at most the radius.
  Mm height(Mm distance) const;
  // Returns the slope there, the height's derivative. It is at most 20: where the arc is steeper, the slope at a
  // smaller distance is returned.
  double slope(Mm distance) const;
  // Returns the largest distance at which slope() is exact.
  Mm steepest() const;
  // Returns the slope of the cone. Only for a cutter with a cone.
  double steepness() const;
  // Returns the distance from the axis where the arc ends: at the cone, or vertically. At most the radius.
  Mm arc_end() const;
  // Returns the shape of all points within the distance `stock` of this one. Its tip is lower by `stock`.
  Cutter grown(Mm stock) const;
  // Returns the stepover that leaves scallops of this height on a flat surface; 0: no scallops, as with a flat end
  // mill.
  Mm step_for_scallop(Mm height) const;
};

// Returns the reason why a cutter is invalid as the expected value in words, e.g. "a diameter of 0.01 mm or more".
// Empty: it is valid.
std::string flaw_of(const Cutter& cutter);

// "flat", "ball", "vee", "bull", "taper".
std::string_view name_of(Cutter::Kind kind);
std::optional<Cutter::Kind> cutter_kind_of(std::string_view name);
// All names, for messages.
inline constexpr const char* cutter_kind_names = "flat, ball, bull, vee or taper";

// Reads "ball:3", "flat:6", "bull:6:1" (corner radius), "vee:60:6", "vee:60:6:0.2" (included angle in degrees,
// diameter, tip) and "taper:1:5:6" (diameter of the ball, half angle in degrees, diameter). Lengths are in mm. The
// failure is a message.
Result<Cutter, std::string> parse_cutter(std::string_view text);

// Describes a cutter for comments and summaries: "ball nose, 3 mm".
std::string describe(const Cutter& cutter);

}  // namespace passo
