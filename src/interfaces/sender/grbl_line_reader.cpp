#include "passo/sender/grbl_line_reader.hpp"

#include <charconv>
#include <limits>
#include <utility>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// The axes of a plane, in the order that makes counterclockwise positive.
std::pair<Axis, Axis> axes_in_plane(int plane) {
  if (plane == 18) return {Axis::z, Axis::x};
  if (plane == 19) return {Axis::y, Axis::z};
  return {Axis::x, Axis::y};
}

}  // namespace

// Returns whether the word is one of those that GrblCode writes.
bool GrblLineReader::take(char letter, double value, GrblLineMotion& line) {
  if (const auto axis = axis_of(letter)) {
    line.end[*axis] = zero_[*axis] + value;
    has_axis_ = true;
    return true;
  }
  switch (letter) {
    case 'I':
    case 'J':
    case 'K': center_.values[static_cast<std::size_t>(letter - 'I')] = value; return true;
    case 'F': modes_.feed = value; return true;
    case 'S': modes_.speed = value; return true;
    case 'P': line.dwell = Seconds(value); return true;
    case 'M':
      line.kind = GrblLineMotion::Kind::rest;
      if (value >= 3 && value <= 5) modes_.spindle = static_cast<int>(value);
      return value >= 3 && value <= 9 && value != 6;
    case 'G': break;
    default: return letter == 'N';
  }
  const int code = static_cast<int>(value);
  if (value != code) return false;
  if (code <= 3) modes_.motion = code;
  if (code == 4) line.kind = GrblLineMotion::Kind::rest;
  if (code >= 17 && code <= 19) modes_.plane = code;
  if (code == 93 || code == 94) modes_.by_time = code == 93;
  const bool is_known_mode = code == 21 || code == 40 || code == 49 || code == 54 || code == 90;
  return code <= 4 || (code >= 17 && code <= 19) || code == 93 || code == 94 || is_known_mode;
}

GrblLineMotion GrblLineReader::read(std::string_view text) {
  GrblLineMotion line{.start = at_, .end = at_};
  const GrblLineModes before = modes_;
  has_axis_ = false;
  center_ = {};
  const char* next = text.data();
  const char* const end = next + text.size();
  bool known = true;
  while (next < end && *next != '\n') {
    const char letter = *next++;
    double value = 0;
    const auto [after, error] = std::from_chars(next, end, value);
    known = known && error == std::errc() && take(letter, value, line);
    if (!known) break;
    next = after;
  }
  if (!known) {
    modes_ = before;
    return {.kind = GrblLineMotion::Kind::unknown, .start = at_, .end = at_};
  }
  if (!has_axis_) return line;
  line.kind = GrblLineMotion::Kind::move;
  const double per_second = modes_.feed / 60;
  line.feed = MmPerSecond(modes_.by_time ? per_second * distance(line.start, line.end) : per_second);
  if (modes_.motion == 0) line.feed = MmPerSecond(std::numeric_limits<double>::infinity());
  if (modes_.motion >= 2) {
    const auto [first, second] = axes_in_plane(modes_.plane);
    line.arc = {.first = first,
                .second = second,
                .first_center = center_[first],
                .second_center = center_[second],
                .clockwise = modes_.motion == 2};
  }
  at_ = line.end;
  return line;
}

}  // namespace passo
