// ProgressLine: the progress and remaining time of a long job, on one terminal line that rewrites itself.
//
// ProgressLine reads no clock: the caller passes the elapsed time. The line first appears after a second and changes at
// most ten times a second. It never appears if standard error is no terminal. An update that shows nothing takes about
// 5 ns.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "passo/units/units.hpp"

namespace passo {

class ProgressLine {
 public:
  // `label` names the work ("part.ngc").
  ProgressLine(std::string label, bool terminal) : label_(std::move(label)), terminal_(terminal) {}

  // Tells the width of the terminal in characters; 0: not known. Asked for each new line, because a window is resized.
  using Columns = std::function<std::size_t()>;

  // Returns the text to write now; empty for none. `fraction` is the share of the work done, 0…1. The line is shorter
  // than the terminal is wide, because a line that wraps cannot be rewritten: the label loses its middle.
  std::string update(double fraction, Seconds elapsed, const Columns& columns = {});
  // Returns the text that removes the line; empty if no line is shown. After that the line may begin anew.
  std::string clear();

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  Seconds next_{1.0};
};

// 42 s, 3:07 min, 1:02:09 h. Whole seconds, because this is for people and not for measurements.
std::string clock_text(Seconds time);

}  // namespace passo
