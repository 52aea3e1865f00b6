// Numbers of the parameters that store offsets (RS274/NGC 3.2.1, and LinuxCNC for the rotation), and functions to read
// the offsets from saved parameters. A work coordinate system has 20 parameters, of which ten are used: the offsets of
// nine axes and the rotation. Values are in the machine's unit and in degrees.
#pragma once

#include <string>

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/parameter_file.hpp"

namespace passo {

inline constexpr int g92_active_parameter = 5210;
inline constexpr int g92_parameter = 5211;
inline constexpr int work_system_parameter = 5220;  // the active work coordinate system
inline constexpr int work_systems = 9;
// Returns the parameter of X. The other axes follow.
constexpr int work_offset_parameter(int system) {
  return 5201 + 20 * system;
}
constexpr int rotation_parameter(int system) {
  return work_offset_parameter(system) + 9;
}

// Returns the parameter of X of the home of G28 (1) or G30 (2). The other axes follow.
constexpr int home_parameter(int home) {
  return 5141 + 20 * home;
}

// Returns 0 if the parameter is not saved.
inline double saved_value(const SavedParameters& saved, int number) {
  const auto found = saved.find(number);
  return found == saved.end() ? 0 : found->second;
}
// Returns the values of nine consecutive parameters, beginning with that of X.
inline Point saved_point(const SavedParameters& saved, int first) {
  Point point;
  for (const Axis axis : all_axes) point[axis] = saved_value(saved, first + static_cast<int>(index_of(axis)));
  return point;
}

// Selects G54, with which programs begin, whatever was active before.
inline void begin_with_g54(SavedParameters& saved) {
  saved[work_system_parameter] = 1;
}
inline void forget_g92(SavedParameters& saved) {
  for (int number = g92_active_parameter; number < work_system_parameter; ++number) saved.erase(number);
}

// Returns "G54" … "G59", "G59.1" … "G59.3", for 1 to 9.
inline std::string name_of_system(int system) {
  constexpr int last_whole = 6;  // G59
  return system <= last_whole ? "G" + std::to_string(53 + system) : "G59." + std::to_string(system - last_whole);
}

}  // namespace passo
