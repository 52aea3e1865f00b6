// The plant that a machine file describes: the simulated hardware behind a simulated or emulated board.
#pragma once

#include <optional>
#include <vector>

#include "passo/activity/touchable.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/plant/rotor_plant.hpp"
#include "passo/plant/travel_switch.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// The homing switches of a machine, in steps from machine zero.
std::vector<TravelSwitch> home_switches(const MachineDescription& machine);

// The screw model of an axis whose screw is described in the machine file, in steps of one of its motors.
ScrewModel screw_model(const AxisDescription& axis, const MotorRow& motor);

// The initial motor positions of that plant for axes at `place`: second motors are ahead by their skew.
MotorSteps truth_at(const MachineDescription& machine, const Point& place);

// The input of the axis' drive alarm, as a bit of BoardInput; 0: none.
std::uint16_t alarm_of(const AxisDescription& axis);
// The pin set-up of the machine's board.
PinSetup pin_setup(const MachineDescription& machine);
// The step and direction timing that the drivers need, and the shortest event interval.
StepTiming step_timing(const BoardDescription& board);

SpindleModel spindle_model(const SpindleDescription& spindle);

// Adds the machine's screws, spindle and limit switches to a plant. `stands_at`: the true machine position. `things`:
// the objects that the probe can touch. Without any, there is the tool setter of the machine, if it has one.
void fit(FittedPlant& plant, const MachineDescription& machine, const Point& stands_at = {},
         const std::vector<Touchable>& things = {});

// An ideal plant with these parts.
IdealPlant plant_of(const MachineDescription& machine, const Point& stands_at = {},
                    const std::vector<Touchable>& things = {});

// The physical data of an axis' motor. Empty: the machine file does not describe the motor, or a full step is not a
// whole number of microsteps.
std::optional<MotorSetup> motor_setup(const AxisDescription& axis);

// Adds the physics of all motors in the machine file to a plant. Call it after fit().
void fit_rotors(RotorPlant& plant, const MachineDescription& machine);

}  // namespace passo
