// read_tool_shapes: reads the shapes of cutters from a TOML file with a table for each tool:
//
//     [tool.1]                    # T1 in the program
//     shape = "taper"             # flat, ball, bull, vee, taper
//     diameter_mm = 6             # largest diameter
//     tip_diameter_mm = 1         # vee: diameter of the flat tip (default: 0); taper: of the ball
//     angle_deg = 12              # vee, taper: included angle
//     corner_radius_mm = 0.5      # bull: corner radius
//     flute_length_mm = 22        # this key and those below are optional
//     holder_diameter_mm = 30
//     holder_from_mm = 28         # from the tip up to the holder
//
// Errors are diagnostics "tools.…".
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/tool_shape.hpp"

namespace passo {

using ToolShapes = std::map<std::int32_t, ToolShape>;  // by tool number, 0 to 99999

// Empty: the file has errors, which are in `diagnostics`.
std::optional<ToolShapes> read_tool_shapes(const std::string& path, Diagnostics& diagnostics);
std::optional<ToolShapes> parse_tool_shapes(std::string_view text, const std::string& file, Diagnostics& diagnostics);

}  // namespace passo
