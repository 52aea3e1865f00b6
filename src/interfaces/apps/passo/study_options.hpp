// The options of the commands that study a single topic: pulses, chords, ramps, motors.
#pragma once

#include <span>

#include "command_table.hpp"
#include "commands.hpp"

namespace passo {

void add_interpolate_options(CLI::App& command, InterpolateArguments& arguments);
void add_chords_options(CLI::App& command, ChordsArguments& arguments);
void add_ramp_options(CLI::App& command, RampArguments& arguments);
void add_motor_options(CLI::App& command, MotorArguments& arguments);
void add_loop_options(CLI::App& command, LoopArguments& arguments);
void add_windings_options(CLI::App& command, WindingsArguments& arguments);
// The subcommands of `passo follower`.
std::span<const Command> follower_commands();

}  // namespace passo
