// LineCase: a move that a student's program interpolates, and the positions of the definition (master and slaves, by
// rounding, halves away from zero).
//
// The cases are always the same, so that two students, and the same student a week later, are graded alike. Each is
// there for a reason, which `why` names: a tie, a master other than the first motor, a known fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace passo {

using StepCounts = std::vector<std::int64_t>;  // of each motor

struct LineCase {
  StepCounts steps;
  std::string why;
};

inline constexpr std::size_t most_graded_motors = 8;

// The cases for a program that asks for `motors` motors (2 to most_graded_motors), or for any number (0). A program
// with three motors gets the cases of two as well; their third motor does not move. With `signs` there are moves in all
// quadrants, too.
std::vector<LineCase> line_cases(std::size_t motors, bool signs);

// The positions after each pulse of the move.
std::vector<StepCounts> line_positions(const StepCounts& steps);

// "(10, 4)".
std::string describe_steps(const StepCounts& steps);

}  // namespace passo
