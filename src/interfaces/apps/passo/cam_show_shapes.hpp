// passo cam show --shapes: the geometry of a drawing, from which operations select their shapes.
#pragma once

#include "cam_commands.hpp"

namespace passo {

// Prints {"layers", "shapes": [{"layer", "color", "names", "line", "closed", "d"}], "box", "left_out"}. `d` is a path
// of SVG in mm, with Y up. Returns an exit code.
int cam_show_shapes(const CamShowArguments& arguments);

}  // namespace passo
