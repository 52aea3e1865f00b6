// Grade: what a student's program did in each case. Whatever a program does is a result: it hangs, crashes, or answers
// wrongly.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace passo {

struct CaseGrade {
  std::string name;      // of the case: "(10, 4)", "first_board/held"
  std::string why = {};  // what the case is about; may be empty
  bool is_right = false;
  std::string fault = {};     // a sentence without a full stop; empty if it is right
  std::int64_t pulse = 0;     // lines: the first wrong pulse, from 1; boards: the number of the change of the output
  std::string output = {};    // boards: the output that is wrong
  double at = 0;              // boards: when, s
  std::string expected = {};  // empty: nothing more
  std::string found = {};     // empty: nothing
};

struct Grade {
  std::string student;
  std::string program = {};  // what was run
  std::string trouble = {};  // why nothing was run; a sentence without a full stop
  std::string remark = {};   // what the teacher should know, e.g. that cases were not played
  std::size_t cases = 0;     // all, those that were not played included
  std::vector<CaseGrade> played = {};

  std::size_t right() const { return static_cast<std::size_t>(std::ranges::count(played, true, &CaseGrade::is_right)); }
  // In per cent.
  double mark() const { return cases == 0 ? 0 : 100.0 * static_cast<double>(right()) / static_cast<double>(cases); }
  // The first wrong case in words; empty if all is right.
  std::string first_fault() const {
    if (!trouble.empty()) return trouble;
    const auto wrong = std::ranges::find(played, false, &CaseGrade::is_right);
    return wrong == played.end() ? "" : wrong->fault;
  }
};

// Gets the fraction that is done, 0 to 1, several times a second while a program runs; returns false to stop. Empty:
// nobody watches.
using GradingWatch = std::function<bool(double)>;

}  // namespace passo
