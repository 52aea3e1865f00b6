// Grades a program for a PIC16F877A (an Intel HEX file): it plays each BoardCase in gpsim. gpsim runs confined, because
// it reads a stranger's file; the program itself cannot leave the emulated chip.
#pragma once

#include <string>

#include "passo/base/result.hpp"
#include "passo/grading/grade.hpp"
#include "passo/grading/submission.hpp"

namespace passo {

// `board`: one of graded_boards(). If `watch` asks to stop, the grade is incomplete. The error is what keeps this
// computer from grading.
Result<Grade, std::string> grade_board(const Submission& submission, const std::string& board,
                                       const GradingWatch& watch = nullptr);

}  // namespace passo
