// The plant that a machine file describes: the world behind a virtual or an emulated board.
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

// The limit switches by which a machine is homed, in steps from machine zero.
std::vector<TravelSwitch> home_switches(const MachineDescription& machine);

// The screw of an axis for which the machine file has one, in steps of one of its motors.
ScrewModel screw_model(const AxisDescription& axis, const MotorRow& motor);

// Where the motors of that plant stand at first, if the axes stand at `place`: second motors are ahead by their skew.
MotorSteps truth_at(const MachineDescription& machine, const Point& place);

// The input at which the drive of the axis gives its alarm, as a bit of BoardInput; 0: it gives none.
std::uint16_t alarm_of(const AxisDescription& axis);
// How the machine's switches and drivers are connected to its board's pins.
PinSetup pin_setup(const MachineDescription& machine);
// What the drivers ask of the board's step and direction pins, and how close its events come.
StepTiming step_timing(const BoardDescription& board);

SpindleModel spindle_model(const SpindleDescription& spindle);

// Gives a plant the machine's screws, spindle and limit switches. `stands_at`: where the machine truly stands, in
// machine coordinates. `things`: what its probe can touch.
void fit(FittedPlant& plant, const MachineDescription& machine, const Point& stands_at = {},
         const std::vector<Touchable>& things = {});

// An ideal plant that was fitted so.
IdealPlant plant_of(const MachineDescription& machine, const Point& stands_at = {},
                    const std::vector<Touchable>& things = {});

// The physics of an axis's motor. Empty: the machine file does not describe the motor, or a full step is not a whole
// number of the driver's steps.
std::optional<MotorSetup> motor_setup(const AxisDescription& axis);

// Gives a plant the physics of all motors that the machine file describes. Call after fit().
void fit_rotors(RotorPlant& plant, const MachineDescription& machine);

}  // namespace passo
