// The geometry of passo cam profile --chamfer. The rim of the tip runs beside the edge and below the chamfer, so that
// the flank cuts it: at the surface, the cutter is wider than the chamfer.
#pragma once

#include <cmath>
#include <numbers>

namespace passo {

inline constexpr double chamfer_margin_mm = 0.1;  // that the flank goes on beside the edge
// Where the cutter's diameter is unknown: wider V-shaped cutters are not usual.
inline constexpr double widest_vee_mm = 50;

// The widest chamfer that the flank can cut; 0 or less: none.
inline double most_chamfer_mm(double cutter_mm, double tip_mm) {
  return (cutter_mm - tip_mm) / 2 - chamfer_margin_mm;
}

// How deep the tip goes. `degrees`: between the two flanks.
inline double chamfer_depth_mm(double width_mm, double degrees) {
  return (width_mm + chamfer_margin_mm) / std::tan(degrees / 360 * std::numbers::pi);
}

}  // namespace passo
