// The options of `passo motor`, which are many.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

CLI::App& add_motor_command(CLI::App& app, MotorArguments& arguments);

}  // namespace passo
