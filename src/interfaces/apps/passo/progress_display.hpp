// ProgressDisplay: shows the progress of a command on standard error if that is a terminal (ProgressLine), and reports
// it to the process that started this one (background_process.hpp). The line is removed when the work is done.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "passo/base/work_progress.hpp"
#include "passo/report/progress.hpp"

namespace passo {

class ProgressDisplay {
 public:
  explicit ProgressDisplay(const std::string& label, bool wanted = true);
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  // `share`: the fraction of the work that is done, 0 to 1.
  // `left`: the remaining time, if it is known.
  void update(double share, std::optional<Seconds> left = {});
  // Removes the line, so that other text can be shown. The next update() shows the line again.
  void clear();
  // Returns a sink for the progress of a computation, which this display must outlive. The line is removed when the
  // work is done.
  WorkProgress work();
  // Clears the display whose line is on the terminal now, if there is one.
  static void clear_shown();

 private:
  ProgressLine line_;
  std::chrono::steady_clock::time_point start_;
  static ProgressDisplay* shown_;  // a process has one terminal
};

}  // namespace passo
