#include "passo/drive/backlash_options.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// In steps. An axis that goes back by less has not turned back, so that noise of a path costs no rests.
constexpr double least_turn = 0.25;

}  // namespace

BacklashOptions backlash_options(const StepOptions& steps, bool counts_items) {
  BacklashOptions options{
      .start = steps.start, .backlash = {}, .least = {}, .downs = steps.downs, .counts_items = counts_items};
  for (const MotorRow& motor : steps.kinematics.rows()) {
    if (!motor.screw) continue;
    const Axis axis = motor.steps.axis();
    options.backlash[axis] = motor.screw->backlash();
    options.least[axis] = least_turn / std::abs(motor.steps.factor());
  }
  return options;
}

bool takes_up_backlash(const StepOptions& steps) {
  const BacklashOptions options = backlash_options(steps, true);
  return std::ranges::any_of(all_axes, [&](Axis axis) { return options.backlash[axis] > 0; });
}

}  // namespace passo
