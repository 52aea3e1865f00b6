// The options of each stage, taken from the machine's description. Nowhere else do stages meet the description.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "passo/interpreter/interpreter.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

bool has_jerk_limit(const MachineDescription& machine);

// `start`: where the machine stands.
PathOptions path_options(const MachineDescription& machine, const std::string& program, const Point& start = {});
Smoothness smoothness(const MachineDescription& machine);
MotionLimits motion_limits(const MachineDescription& machine);
// The motors that the host plans: one for each axis.
Kinematics kinematics_of(const MachineDescription& machine);
// All motors of the board: after those, the second motors of axes that have two.
Kinematics board_kinematics_of(const MachineDescription& machine);
StepOptions step_options(const MachineDescription& machine);
// The steps of each motor from machine zero, rounded to the step nearest to `place`. `downs`: the axes whose backlash
// is taken up for motion down.
std::array<std::int64_t, max_motors> steps_at(const MachineDescription& machine, const Point& place,
                                              AxisSet downs = {});

}  // namespace passo
