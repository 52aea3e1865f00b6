// ProgressLine: the progress and remaining time of a long job, on one terminal line that is rewritten.
//
// ProgressLine reads no clock: the caller passes the elapsed time. The line first appears after a second and changes at
// most ten times a second. It never appears if standard error is not a terminal. An update that shows nothing takes
// about 5 ns.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "passo/units/units.hpp"

namespace passo {

class ProgressLine {
 public:
  // `label` names the job ("part.ngc").
  ProgressLine(std::string label, bool terminal) : label_(std::move(label)), terminal_(terminal) {}

  // Returns the width of the terminal in characters; 0: unknown. Called for each new line, because the window may be
  // resized.
  using Columns = std::function<std::size_t()>;

  // Returns the text to write now; empty if there is nothing to write. `fraction` is the completed fraction, 0…1. The
  // line is shorter than the terminal is wide, because a wrapped line cannot be rewritten: the label is shortened in
  // the middle.
  // `left`: the remaining time, if it is known; otherwise it is estimated by the elapsed time.
  std::string update(double fraction, Seconds elapsed, const Columns& columns = {}, std::optional<Seconds> left = {});
  // Returns the text that removes the line; empty if no line is shown. The next update may show it again.
  std::string clear();

 private:
  std::string label_;
  bool terminal_;
  bool shown_ = false;
  Seconds next_{1.0};
};

// Formats a duration: 42 s, 3:07 min, 1:02:09 h. Whole seconds, since it is for display and not for measurements.
std::string clock_text(Seconds time);

}  // namespace passo
