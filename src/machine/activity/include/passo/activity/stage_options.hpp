// The options of each stage, derived from the machine's description. This is the only connection between stages and the
// description.
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

// Adds to the options of an interpreter what the machine does at M6.
InterpreterOptions on_machine(const MachineDescription& machine, InterpreterOptions options);

bool has_jerk_limit(const MachineDescription& machine);

// `start`: the machine position at the start.
PathOptions path_options(const MachineDescription& machine, const std::string& program, const Point& start = {});
// The digital outputs, as bits of OutputSwitch, that stay on in holds and stop ramps.
std::uint8_t kept_in_stops(const MachineDescription& machine);
Smoothness smoothness(const MachineDescription& machine);
// The fraction of each tolerance that smoothing may use. The rest is for backlash that is taken up in motion.
double smoothing_share(const MachineDescription& machine);
MotionLimits motion_limits(const MachineDescription& machine);
// The motors that the host plans: one for each axis.
Kinematics kinematics_of(const MachineDescription& machine);
// All motors of the board: those, followed by the second motors of axes that have two.
Kinematics board_kinematics_of(const MachineDescription& machine);
StepOptions step_options(const MachineDescription& machine);
// The steps of each motor from machine zero to `place`, rounded to the nearest step. `downs`: the axes whose backlash
// is taken up for motion in the negative direction.
std::array<std::int64_t, max_motors> steps_at(const MachineDescription& machine, const Point& place,
                                              AxisSet downs = {});

}  // namespace passo
