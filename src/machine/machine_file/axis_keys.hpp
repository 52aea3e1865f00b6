// The keys of an axis in a machine file that carry a unit in their names.
#pragma once

#include "passo/toml/table_reader.hpp"

namespace passo {

struct AxisKeys {
  const char* unit;
  NumberKey scale;
  NumberKey gear;
  NumberKey travel;
  NumberKey velocity;
  NumberKey acceleration;
  NumberKey jerk;
  NumberKey start_stop;
};
inline constexpr AxisKeys linear_keys{
    .unit = "mm",
    .scale = {"steps_per_mm", 1e-3, 1e6, "100"},
    .gear = {"screw_pitch_mm", 1e-2, 1e3, "4"},
    .travel = {"travel_mm", -1e5, 1e5, "[-150, 150]"},
    .velocity = {"max_velocity_mm_s", 1e-3, 1e5, "25"},
    .acceleration = {"max_acceleration_mm_s2", 1e-3, 1e6, "200"},
    .jerk = {"max_jerk_mm_s3", 1e-3, 1e9, "5000"},
    .start_stop = {"start_stop_velocity_mm_s", 0, 1e5, "2"},
};
inline constexpr AxisKeys rotary_keys{
    .unit = "deg",
    .scale = {"steps_per_deg", 1e-3, 1e6, "40"},
    .gear = {"gear_ratio", 1e-3, 1e5, "36"},
    .travel = {"travel_deg", -1e7, 1e7, "[-180, 180]"},
    .velocity = {"max_velocity_deg_s", 1e-3, 1e5, "60"},
    .acceleration = {"max_acceleration_deg_s2", 1e-3, 1e6, "300"},
    .jerk = {"max_jerk_deg_s3", 1e-3, 1e9, "8000"},
    .start_stop = {"start_stop_velocity_deg_s", 0, 1e5, "5"},
};

}  // namespace passo
