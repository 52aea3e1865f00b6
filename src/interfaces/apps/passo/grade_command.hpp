// The arguments of `passo grade`: a student's program, or a class's folder, and what is written about it.
#pragma once

#include <string>
#include <vector>

namespace passo {

struct GradeOutputs {
  std::string csv;     // a row for each student; empty: none
  std::string report;  // .html; empty: none
  bool json = false;   // prints all as JSON
};

struct GradeLinesArguments {
  std::string program;  // a file, a command line, or a folder with an entry for each student
  std::string motors;   // "2" to "8", "any", or empty: found by a trial
  bool signs = false;
  bool count_first = false;
  std::string run;                    // the command line that runs each program; "{}" stands for its file
  std::vector<std::string> readable;  // more folders that programs may read
  unsigned memory = 256;              // MB
  bool unconfined = false;
  GradeOutputs outputs;
};
int grade_lines_command(const GradeLinesArguments& arguments);

struct GradeBoardArguments {
  std::string program;  // a .hex file, or a folder
  std::string board = "first_board";
  GradeOutputs outputs;
};
int grade_board_command(const GradeBoardArguments& arguments);

}  // namespace passo
