// ProgressDisplay: a ProgressLine on standard error, with the clock. The line is removed when the work is done.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "program_input.hpp"
#include <unistd.h>

#include "passo/report/progress.hpp"

namespace passo {

class ProgressDisplay {
 public:
  explicit ProgressDisplay(const std::string& label, bool wanted = true)
      : line_(label, wanted && rewrites_lines(STDERR_FILENO)), start_(std::chrono::steady_clock::now()) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void update(double fraction) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    show(line_.update(fraction, Seconds(elapsed.count()), [] { return columns_of(STDERR_FILENO); }));
  }
  // Removes the line, so that other text can be shown. The next update() shows the line again.
  void clear() { show(line_.clear()); }

 private:
  static void show(const std::string& text) {
    if (!text.empty()) std::fwrite(text.data(), 1, text.size(), stderr);
  }

  ProgressLine line_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace passo
