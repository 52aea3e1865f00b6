// Grades a program that interpolates lines: it asks for the steps of motor 1, 2, … and prints the positions after each
// pulse. Each case is a run of its own, confined (passo/confinement).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/confinement/confined_run.hpp"
#include "passo/grading/grade.hpp"
#include "passo/grading/submission.hpp"

namespace passo {

struct LineGrading {
  static constexpr std::size_t as_the_program = 99;  // found by a trial with eight motors

  std::size_t motors = as_the_program;  // for how many the program has to ask; 0: any number
  bool signs = false;                   // also moves with negative steps
  bool asks_count = false;              // the program first asks for the number of motors
  bool unconfined = false;
  std::vector<std::string> readable = {};
  ProgramLimits limits = {};
};

// What the program gets for a case: the steps, a line each, and an empty line.
std::string dialogue_for(const std::vector<std::int64_t>& steps, bool asks_count);

// If `watch` asks to stop, the grade is incomplete. The error is what keeps this computer from grading.
Result<Grade, std::string> grade_lines(const Submission& submission, const LineGrading& grading,
                                       const GradingWatch& watch = nullptr);

}  // namespace passo
