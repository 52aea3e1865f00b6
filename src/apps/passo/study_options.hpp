// The options of the commands that study one thing at a time: pulses, chords, ramps, motors.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

CLI::App& add_interpolate_command(CLI::App& app, InterpolateArguments& arguments);
CLI::App& add_chords_command(CLI::App& app, ChordsArguments& arguments);
CLI::App& add_ramp_command(CLI::App& app, RampArguments& arguments);
CLI::App& add_motor_command(CLI::App& app, MotorArguments& arguments);
CLI::App& add_loop_command(CLI::App& app, LoopArguments& arguments);
CLI::App& add_follower_command(CLI::App& app, FollowerArguments& arguments);
CLI::App& add_windings_command(CLI::App& app, WindingsArguments& arguments);

}  // namespace passo
