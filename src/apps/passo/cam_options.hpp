// The options of `passo cam`, which makes programs of drawings.
#pragma once

#include "commands.hpp"

namespace CLI {
class App;
}

namespace passo {

// Returns the command `cam drill`.
CLI::App& add_cam_command(CLI::App& app, CamDrillArguments& arguments);
// `cam`: the command that add_cam_command() has added.
CLI::App& add_cam_relief_command(CLI::App& cam, CamReliefArguments& arguments);

}  // namespace passo
