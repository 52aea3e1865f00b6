#include "screw_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
// In steps. So near to a border of the errors, a place counts as on it. Crossings are found far better than this, and
// the errors of both sides agree there to a millionth of a step.
constexpr double border_steps = 1e-4;

struct Range {
  double low = 0;  // steps
  double high = 0;
};

// Where a motor that follows its axis in proportion leaves the range. Infinity if it does not before the path's end.
double leaves(const MotorPath& path, unsigned motor, const Range& range, double from) {
  MotorPath::Spot spot = path.at(from);
  for (;;) {
    const double border = path.rises(motor, spot) ? range.high : range.low;
    const double target = (border + 0.5) * place_per_step;
    const double s = std::isfinite(target) ? path.crossing(motor, target, spot).s : unbounded;
    if (s < unbounded) return s;
    const double turn = path.turning_point(motor, spot.s);
    if (!(turn < path.end())) return unbounded;
    spot = path.at(turn);
  }
}

}  // namespace

ScrewParts::ScrewParts(const StepOptions& options) : downs_(options.downs) {
  const std::span<const MotorRow> motors = options.kinematics.rows();
  for (std::size_t m = 0; m < motors.size(); ++m) {
    if (!motors[m].screw) continue;
    scales_[m] = motors[m].steps.factor();
    any_ = true;
  }
}

double ScrewParts::fit(const Curve& curve, double from, double end, std::span<MotorRow> motors) const {
  for (std::size_t m = 0; m < motors.size(); ++m) {
    if (!motors[m].screw) continue;
    motors[m].steps = {motors[m].steps.axis(), scales_[m]};
    motors[m].offset = 0;
  }
  MotorPath axes;  // the motors as if their screws were perfect
  axes.start(curve, end, motors);
  const Point place = curve.at(Mm(from));
  double until = end;
  for (unsigned m = 0; m < motors.size(); ++m) {
    MotorRow& motor = motors[m];
    if (!motor.screw) continue;
    if (takes_up_backlash_) {
      fit_backlash(curve, motor, scales_[m]);
      continue;
    }
    const Axis axis = motor.steps.axis();
    const bool up = axes.rises(m, axes.at(from)) == (scales_[m] > 0);
    const auto& piece = motor.screw->piece_at(place[axis], up, border_steps / std::fabs(scales_[m]));
    const double one = piece.low * scales_[m];
    const double other = piece.high * scales_[m];
    until = std::min(until, leaves(axes, m, {.low = std::min(one, other), .high = std::max(one, other)}, from));
    motor.steps = {axis, scales_[m] * piece.slope};
    motor.offset = scales_[m] * (piece.offset - (downs_.has(axis) ? motor.screw->backlash() : 0));
  }
  return std::max(until, from);
}

// The motor alone moves, and its slide stands at the end of the curve.
void ScrewParts::fit_backlash(const Curve& curve, MotorRow& motor, double scale) const {
  const Axis axis = motor.steps.axis();
  const double stands_at = curve.end()[axis];
  motor.offset = scale * (motor.screw->nominal(stands_at, downs_.has(axis)) - stands_at);
}

}  // namespace passo
