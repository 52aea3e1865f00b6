// The options of `passo cam`, which makes programs of drawings.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

// Returns the command `cam drill`.
CLI::App& add_cam_command(CLI::App& app, CamDrillArguments& arguments);

}  // namespace passo
