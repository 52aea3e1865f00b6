// read_tool_shapes: the shapes of the cutters, from a file in TOML with a table for each tool:
//
//     [tool.1]                    # T1 in the program
//     shape = "taper"             # flat, ball, bull, vee, taper
//     diameter_mm = 6             # where it is widest
//     tip_diameter_mm = 1         # vee: of its flat tip, 0 without; taper: of the ball
//     angle_deg = 12              # vee, taper: between the two sides
//     corner_radius_mm = 0.5      # bull: of its round corners
//     flute_length_mm = 22        # all below may be left out
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

using ToolShapes = std::map<std::int32_t, ToolShape>;  // by the tool's number, 0 to 99999

// Empty: the file has errors, which are in `diagnostics`.
std::optional<ToolShapes> read_tool_shapes(const std::string& path, Diagnostics& diagnostics);
std::optional<ToolShapes> parse_tool_shapes(std::string_view text, const std::string& file, Diagnostics& diagnostics);

}  // namespace passo
