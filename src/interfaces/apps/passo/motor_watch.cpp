#include "motor_watch.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "passo/activity/stage_options.hpp"

namespace passo {

MotorWatch::MotorWatch(RotorPlant& plant, const MachineDescription& machine, Seconds begins)
    : plant_(plant), begins_(begins), lines_(begins), motors_(machine.motor_count()) {
  const Kinematics board = board_kinematics_of(machine);
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const auto watch = [&](std::size_t motor) {
      motors_[motor] = {.axis = &axis, .scale = board.rows()[motor].steps.factor_of(axis.axis), .worst_line = 0};
    };
    watch(m);
    if (axis.second) watch(machine.second_motor_of(m));
  }
}

void MotorWatch::poll(Seconds now) {
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    const RotorRecord& record = plant_.record(m);
    if (record.least_margin_at > looked_) motors_[m].worst_line = lines_.line_at(record.least_margin_at);
  }
  while (lines_of_losses_.size() < plant_.losses().size()) {
    lines_of_losses_.push_back(lines_.line_at(plant_.losses()[lines_of_losses_.size()].time));
  }
  if (fault_line_ == 0 && plant_.following_fault()) fault_line_ = lines_.line_at(plant_.following_fault()->time);
  looked_ = now;
  lines_.forget_before(now);
}

PhysicsSummary MotorWatch::finish(Seconds now) {
  constexpr Seconds longest_ringing{2};
  static_cast<void>(plant_.settle(longest_ringing));  // what still rings then is far below a step
  poll(now);
  const Truth truth = plant_.truth_at(now);
  PhysicsSummary summary;
  summary.fault_line = fault_line_;
  for (std::size_t m = 0; m < motors_.size(); ++m) {
    const AxisDescription& axis = *motors_[m].axis;
    const RotorRecord& record = plant_.record(m);
    const double scale = motors_[m].scale;
    summary.motors.push_back({.axis = axis.axis,
                              .lost_steps = scale < 0 ? -record.lost : record.lost,
                              .lost = static_cast<double>(record.lost) / scale,
                              .following_error = plant_.steps_per_full_step(m) * record.most_lag / std::abs(scale),
                              .least_margin = record.least_margin,
                              .line = motors_[m].worst_line,
                              .least_margin_at = record.least_margin_at - begins_,
                              .position = truth.positions[m] / scale});
  }
  for (std::size_t i = 0; i < plant_.losses().size(); ++i) {
    const StepLoss& loss = plant_.losses()[i];
    summary.losses.push_back({.time = loss.time - begins_,
                              .axis = motors_[loss.motor].axis->axis,
                              .steps = motors_[loss.motor].scale < 0 ? -loss.steps : loss.steps,
                              .line = lines_of_losses_[i]});
  }
  return summary;
}

}  // namespace passo
