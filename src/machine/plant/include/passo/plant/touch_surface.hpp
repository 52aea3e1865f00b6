// TouchSurface: an object in a plant that the probe can touch: everything on or below a surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "passo/geometry/surface.hpp"
#include "passo/plant/motor_steps.hpp"

namespace passo {

// The probe is a point.
class TouchSurface {
 public:
  // How a machine coordinate depends on a motor. Without a motor the coordinate stays at 0.
  struct Along {
    std::optional<std::size_t> motor = {};
    double steps_per_mm = 1;  // negative: the motor has the reversed direction
    double zero = 0;          // zero of the surface, in machine coordinates
  };

  TouchSurface(std::shared_ptr<const Surface> surface, const std::array<Along, 3>& along)
      : surface_(std::move(surface)), along_(along) {
    for (const Along& one : along_) {
      if (one.motor) least_scale_ = std::min(least_scale_, std::abs(one.steps_per_mm));
    }
  }

  bool contains(const MotorPositions& positions) const {
    const SurfacePoint at = place(positions);
    return at.z <= surface_->top(at.x, at.y) + rounding;
  }
  // Returns how many steps any motor may move until the probe may start or stop touching the surface.
  double steps_to_border(const MotorPositions& positions) const {
    return std::max(1.0, (surface_->clearance(place(positions)) - rounding) * least_scale_);
  }

 private:
  static constexpr double rounding = 1e-9;  // mm, for the conversion of steps to millimetres

  SurfacePoint place(const MotorPositions& positions) const {
    const auto along = [&](const Along& one) {
      return (one.motor ? positions[*one.motor] / one.steps_per_mm : 0) - one.zero;
    };
    return {along(along_[0]), along(along_[1]), along(along_[2])};
  }

  std::shared_ptr<const Surface> surface_;
  std::array<Along, 3> along_;
  double least_scale_ = std::numeric_limits<double>::infinity();
};

}  // namespace passo
