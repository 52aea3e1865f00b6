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

bool begins_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

// The first so many characters of a UTF-8 text.
std::string_view first_of(std::string_view text, std::size_t count) {
  std::size_t size = 0;
  while (size < text.size() && (count > 0 || !begins_character(text[size]))) {
    if (begins_character(text[size])) --count;
    ++size;
  }
  return text.substr(0, size);
}

// At most `room` characters of the text. The start of a name tells the job, and the end tells the kind of file, so
// that the middle is left out.
std::string shortened(std::string_view text, std::size_t room) {
  const std::size_t length = characters(text);
  if (length <= room) return std::string(text);
  if (room == 0) return {};
  const std::size_t tail = (room - 1) / 2;
  return fmt::format("{}\u2026{}", first_of(text, room - 1 - tail), text.substr(first_of(text, length - tail).size()));
}

}  // namespace

std::string ProgressLine::update(double fraction, Seconds elapsed, const Columns& columns,
                                 std::optional<Seconds> left) {
  if (!terminal_ || elapsed < next_) return {};
  next_ = elapsed + pause;
  shown_ = true;
  fraction = std::clamp(std::isnan(fraction) ? 0.0 : fraction, 0.0, 1.0);
  // Rounded down, so that 100 % appears only when all is done.
  std::string figures = fmt::format(" {:3.0f} %", std::floor(100 * fraction));
  if (!left && fraction >= smallest_share) left = elapsed * (1 / fraction - 1);
  if (left) figures += fmt::format(", {} left", clock_text(*left));
  const std::size_t width = columns ? columns() : 0;
  if (width == 0) return fmt::format("{}{}{}", to_line_start_and_erase, label_, figures);
  figures = first_of(figures, width - 1);
  return fmt::format("{}{}{}", to_line_start_and_erase, shortened(label_, width - 1 - figures.size()), figures);
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
