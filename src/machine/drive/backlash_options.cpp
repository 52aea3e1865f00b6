#include "passo/drive/backlash_options.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// In steps. An axis that goes back by less has not turned back, so that noise of a path costs no rests.
constexpr double least_turn = 0.25;

}  // namespace

BacklashOptions backlash_options(const StepOptions& steps, Smoothness smoothness, bool counts_items) {
  BacklashOptions options{.start = steps.start,
                          .backlash = {},
                          .least = {},
                          .downs = steps.downs,
                          .counts_items = counts_items,
                          .smoothness = smoothness};
  for (const MotorRow& motor : steps.kinematics.rows()) {
    if (!motor.screw) continue;
    const Axis axis = motor.steps.axis();
    options.backlash[axis] = motor.screw->backlash();
    options.least[axis] = least_turn / std::abs(motor.steps.factor());
    if (motor.screw->can_take_up_in_motion()) options.in_motion.add(axis);
  }
  if (!options.in_motion.empty()) options.smoothing_share = smoothing_share_with_backlash;
  return options;
}

bool takes_up_backlash(const StepOptions& steps) {
  const BacklashOptions options = backlash_options(steps, Smoothness::least_bending, true);
  return std::ranges::any_of(all_axes, [&](Axis axis) { return options.backlash[axis] > 0; });
}

}  // namespace passo
