// LineAnswer: the positions that a student's program printed, and the first pulse that is wrong.
//
// The expected form is a line for each pulse with the positions of all motors. How they are separated does not matter,
// nor what stands before them: an answer begins behind the prompts, because input from a pipe has no line ends on the
// screen. Accepted are also the steps that were asked for as the first line, the start, the end as a second last line,
// headings that do not end with numbers, the number of the pulse before the positions, names ("x=3 y=1"), brackets,
// decimals (3.0) and CRLF.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/grading/line_case.hpp"

namespace passo {

using PrintedPosition = std::vector<double>;

// The lines of `output` that end with a position of so many motors.
std::vector<PrintedPosition> printed_positions(std::string_view output, std::size_t motors);

// The number of motors for which a program asks, from what it printed when it was offered `steps` for
// most_graded_motors motors; 0: any number.
std::size_t count_motors(std::string_view output, const StepCounts& steps);

struct AnswerFault {
  std::int64_t pulse = 0;  // from 1; 0: none
  std::string expected;    // the position of the definition; empty: no pulse more
  std::string found;       // empty: the program printed no more
  std::string words;       // a sentence without a full stop; empty: the answer is right
};

// Compares an answer with the definition.
AnswerFault find_fault(const LineCase& asked, std::string_view output);

}  // namespace passo
