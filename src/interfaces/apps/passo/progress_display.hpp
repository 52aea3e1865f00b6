// ProgressDisplay: the progress of a command, on standard error of a terminal (ProgressLine) and for the process that
// started this one (background_process.hpp). The line is removed when the work is done.
#pragma once

#include <chrono>
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

  // This share of the work, 0 to 1, is done.
  void update(double share);
  // Removes the line, so that other text can be shown. The next update() shows the line again.
  void clear();
  // For a computation, which this outlives. The line is removed when all is done.
  WorkProgress work();
  // The same as clear(), for the display whose line is on the terminal now, if any.
  static void clear_shown();

 private:
  ProgressLine line_;
  std::chrono::steady_clock::time_point start_;
  static ProgressDisplay* shown_;  // a process has one terminal
};

}  // namespace passo
