#include "passo/verdict/proof_options.hpp"

#include <functional>

namespace passo {
namespace {

// The exact curve. The referee does not rely on the planner's samples.
std::function<MmPerSecond2(MmPerSecond)> proven_limit(const AxisDescription& axis) {
  if (!axis.follows_torque()) return {};
  return [axis](MmPerSecond speed) { return axis.acceleration_at(speed); };
}

}  // namespace

ProofOptions proof_options(const MachineDescription& machine) {
  ProofOptions options;
  for (const AxisDescription& axis : machine.axes) {
    options.axes.push_back({.axis = axis.axis,
                            .step = axis.step(),
                            .velocity = axis.velocity,
                            .acceleration = axis.acceleration,
                            .jerk = axis.jerk,
                            .start_stop = axis.start_stop,
                            .backlash = Mm(axis.screw ? axis.screw->backlash : 0),
                            .acceleration_at = proven_limit(axis),
                            .surface_radius = axis.surface_radius});
  }
  options.tick_rate = machine.board.clock;
  return options;
}

}  // namespace passo
