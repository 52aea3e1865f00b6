// Grades a program for a PIC16F877A (an Intel HEX file): it plays each BoardCase in gpsim. gpsim runs confined, because
// it reads a stranger's file; the program itself cannot leave the emulated chip.
#pragma once

#include <functional>
#include <string>

#include "passo/base/result.hpp"
#include "passo/grading/grade.hpp"
#include "passo/grading/submission.hpp"

namespace passo {

// `board`: one of graded_boards(). `watch` gets the fraction that is done. The error is what keeps this computer from
// grading.
Result<Grade, std::string> grade_board(const Submission& submission, const std::string& board,
                                       const std::function<void(double)>& watch = nullptr);

}  // namespace passo
