// ProgressLine: how far a long job is and how long it will take, on one line of a terminal that rewrites itself.
//
// Reads no clock: the caller tells the elapsed time. Nothing is shown for work under a second, more often than ten
// times a second, or where standard error is no terminal. About 5 ns an update that shows nothing.
#pragma once

#include <string>

#include "passo/units/units.hpp"

namespace passo {

class ProgressLine {
 public:
  // `label` says what is being done ("part.ngc").
  ProgressLine(std::string label, bool terminal) : label_(std::move(label)), terminal_(terminal) {}

  // What to write now, or nothing. `fraction` of the work done, 0…1.
  std::string update(double fraction, Seconds elapsed);
  // What takes the line away again, or nothing when none was shown. Afterwards it may begin anew.
  std::string clear();

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  Seconds next_{1.0};
};

// 42 s, 3:07 min, 1:02:09 h. Whole seconds: for people, not for measurements.
std::string clock_text(Seconds time);

}  // namespace passo
