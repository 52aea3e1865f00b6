// placed_program: the program of an operation for another copy of the part: turned about X0 Y0, then moved.
//
// It reads programs as the operations write them: absolute positions, one motion per line, arcs with I and J, canned
// cycles with X and Y. Heights, feeds and tools stay. All numbers are in the program's unit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct ProgramPlace {
  double degrees = 0;  // counterclockwise
  double x = 0;
  double y = 0;
};

// `park`: "X0 Y0", the park position of the program, which stays.
std::string placed_program(std::string_view program, const ProgramPlace& place, std::string_view park);

// Whether the program can be turned: it has no arcs in the planes G18 and G19.
bool can_be_turned(std::string_view program);

// The program of each tool, with the beginning of the whole program. One tool: the program itself.
std::vector<std::string> programs_of_tools(std::string_view program);

// Positions of the tip below Z0, at most `step` apart.
struct ProgramPoint {
  double x = 0;
  double y = 0;
  double z = 0;
};
std::vector<ProgramPoint> cut_points_of(std::string_view program, double step);

}  // namespace passo
