#include "progress_display.hpp"

#include <cstdio>
#include <cstdlib>

#include "background_process.hpp"
#include "terminal.hpp"
#include <unistd.h>

#include "passo/base/percent_line.hpp"

namespace passo {
namespace {

void write_line(const std::string& text) {
  if (!text.empty()) std::fwrite(text.data(), 1, text.size(), stderr);
}

// The process that started this one hears of it only if it has asked. The pipe never fills (percent_line.hpp), and a
// reader that is gone needs nothing.
void tell_starter(double share) {
  static const bool is_asked = std::getenv(BackgroundProcess::wants_progress) != nullptr;
  static PercentSender sender;
  if (!is_asked) return;
  const auto message = sender.next(share);
  if (message && write(BackgroundProcess::progress_pipe, &*message, sizeof *message) < 0) return;
}

}  // namespace

ProgressDisplay* ProgressDisplay::shown_ = nullptr;

ProgressDisplay::ProgressDisplay(const std::string& label, bool wanted)
    : line_(label, wanted && rewrites_lines(STDERR_FILENO)), start_(std::chrono::steady_clock::now()) {}

void ProgressDisplay::update(double share, std::optional<Seconds> left) {
  tell_starter(share);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  write_line(line_.update(
      share, Seconds(elapsed.count()), [] { return columns_of(STDERR_FILENO); }, left));
  shown_ = this;
}

void ProgressDisplay::clear() {
  write_line(line_.clear());
  if (shown_ == this) shown_ = nullptr;
}

WorkProgress ProgressDisplay::work() {
  return WorkProgress([this](double share) {
    update(share);
    if (share >= 1) clear();
  });
}

void ProgressDisplay::clear_shown() {
  if (shown_ != nullptr) shown_->clear();
}

}  // namespace passo
