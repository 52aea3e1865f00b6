#include "passo/report/progress.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr Seconds pause{0.1};
// Below this share the estimate of the time left is too unsteady to be useful.
constexpr double smallest_share = 0.005;
constexpr std::string_view to_line_start_and_erase = "\r\x1b[K";

}  // namespace

std::string ProgressLine::update(double fraction, Seconds elapsed) {
  if (!terminal_ || elapsed < next_) return {};
  next_ = elapsed + pause;
  shown_ = true;
  fraction = std::clamp(std::isnan(fraction) ? 0.0 : fraction, 0.0, 1.0);
  // Rounded down, so that 100 % appears only when all is done.
  std::string line = fmt::format("{}{} {:3.0f} %", to_line_start_and_erase, label_, std::floor(100 * fraction));
  if (fraction >= smallest_share) line += fmt::format(", {} left", clock_text(elapsed * (1 / fraction - 1)));
  return line;
}

std::string ProgressLine::clear() {
  next_ = Seconds(1.0);
  if (!shown_) return {};
  shown_ = false;
  return std::string(to_line_start_and_erase);
}

std::string clock_text(Seconds time) {
  constexpr double longest = 1e15;  // beyond this a double no longer counts seconds
  const auto seconds = std::llround(std::clamp(time.value(), 0.0, longest));
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{}:{:02} min", seconds / 60, seconds % 60);
  return fmt::format("{}:{:02}:{:02} h", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace passo
