// The members of a tool in our JSON: the keys of [tool.N], without its number and chip loads. Private to tool_import/.
#pragma once

#include <array>
#include <string_view>

namespace passo {

inline constexpr std::array<std::string_view, 20> tool_json_names = {"name",
                                                                     "shape",
                                                                     "diameter_mm",
                                                                     "corner_radius_mm",
                                                                     "angle_deg",
                                                                     "tip_diameter_mm",
                                                                     "neck_diameter_mm",
                                                                     "teeth",
                                                                     "pitch_mm",
                                                                     "tooth_tip_mm",
                                                                     "reach_mm",
                                                                     "flutes",
                                                                     "flute_length_mm",
                                                                     "stick_out_mm",
                                                                     "holder_diameter_mm",
                                                                     "centre_cutting",
                                                                     "material",
                                                                     "max_rpm",
                                                                     "life_m",
                                                                     "life_min"};

}  // namespace passo
