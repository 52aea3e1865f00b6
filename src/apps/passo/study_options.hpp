// The options of the commands that study one thing at a time: pulses, chords, ramps, motors.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

CLI::App& add_interpolate_command(CLI::App& app, const std::vector<std::string>& words,
                                  InterpolateArguments& arguments);
CLI::App& add_chords_command(CLI::App& app, const std::vector<std::string>& words, ChordsArguments& arguments);
CLI::App& add_ramp_command(CLI::App& app, const std::vector<std::string>& words, RampArguments& arguments);
CLI::App& add_motor_command(CLI::App& app, const std::vector<std::string>& words, MotorArguments& arguments);
CLI::App& add_loop_command(CLI::App& app, const std::vector<std::string>& words, LoopArguments& arguments);
CLI::App& add_follower_command(CLI::App& app, const std::vector<std::string>& words, FollowerArguments& arguments);
CLI::App& add_windings_command(CLI::App& app, const std::vector<std::string>& words, WindingsArguments& arguments);

}  // namespace passo
