#include "passo/sender/grbl_forecast.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace passo {
namespace {

// A stretch of lines that takes the connection so long tells the feed that it carries; shorter ones lie in the buffers.
constexpr double stretch_time = 1;         // s
constexpr std::size_t most_lines = 20000;  // of a stretch

// The first settings of each kind; that of the next axis follows.
constexpr int steps_per_mm = 100;
constexpr int velocity = 110;
constexpr int acceleration = 120;

// The axes of a plane, in the order that makes counterclockwise positive.
std::pair<Axis, Axis> axes_of_plane(int plane) {
  if (plane == 18) return {Axis::z, Axis::x};
  if (plane == 19) return {Axis::y, Axis::z};
  return {Axis::x, Axis::y};
}

}  // namespace

// The words of a line.
struct GrblForecast::Words {
  enum class Kind : std::uint8_t { modes, move, rest };
  Kind kind = Kind::modes;
  std::optional<GrblPlanner::Arc> arc = {};
  Point end = {};
  MmPerSecond feed{0};
  Seconds dwell{0};
  std::uint32_t source = 0;
};

GrblLimits limits_of(const GrblMachine& machine) {
  const auto setting = [&](int number, double fallback) {
    const auto found = machine.settings.find(number);
    return found == machine.settings.end() ? fallback : found->second;
  };
  GrblLimits limits{.junction_deviation = Mm(std::max(0.0, setting(11, 0.01))),
                    .arc_tolerance = Mm(setting(12, 0.002)),
                    .blocks = machine.blocks};
  for (std::size_t i = 0; i < machine.axes.size() && i < axis_count; ++i) {
    const auto axis = axis_of(machine.axes[i]);
    if (!axis) continue;
    const int number = static_cast<int>(i);
    limits.steps_per_mm[*axis] = setting(steps_per_mm + number, 0);
    limits.velocity[*axis] = MmPerSecond(setting(velocity + number, 500) / 60);
    limits.acceleration[*axis] = MmPerSecond2(setting(acceleration + number, 10));
  }
  return limits;
}

GrblForecast::GrblForecast(const GrblLimits& limits, const GrblLine& line, const Point& start, const GrblTarget& target)
    : line_(line), target_(target), at_(start), hindered_(limits, start), unhindered_(limits, start) {}

void GrblForecast::add(std::string_view text, std::uint32_t source) {
  Words words{.end = at_, .source = source};
  PerAxis<double> center;
  bool has_axis = false;
  const char* next = text.data();
  const char* const end = next + text.size();
  while (next < end) {
    const char letter = *next++;
    double value = 0;
    const auto [after, error] = std::from_chars(next, end, value);
    if (error != std::errc()) break;
    next = after;
    const auto axis = axis_of(letter);
    if (axis) {
      words.end[*axis] = target_.zero[*axis] + value;
      has_axis = true;
    } else if (letter >= 'I' && letter <= 'K') {
      center.values[static_cast<std::size_t>(letter - 'I')] = value;
    } else if (letter == 'F') {
      feed_ = value / 60;
    } else if (letter == 'P') {
      words.dwell = Seconds(value);
    } else if (letter == 'M' || (letter == 'G' && value == 4)) {
      words.kind = Words::Kind::rest;
    } else if (letter == 'G' && value <= 3) {
      motion_ = static_cast<int>(value);
    } else if (letter == 'G' && value >= 17 && value <= 19) {
      plane_ = static_cast<int>(value);
    } else if (letter == 'G' && (value == 93 || value == 94)) {
      by_time_ = value == 93;
    }
  }
  if (has_axis) words.kind = Words::Kind::move;
  const Point way = words.end - at_;
  double length2 = 0;
  for (const double part : way.values) length2 += part * part;
  double feed = by_time_ ? feed_ * std::sqrt(length2) : feed_;
  // An arc on such a board is in the XY plane, and steep at most in short helices.
  if (target_.measures_motors && !by_time_ && length2 > 0) {
    feed *= motion_ >= 2 ? std::numbers::sqrt2 / 2 : std::sqrt(length2) / target_.way(way);
  }
  words.feed = MmPerSecond(motion_ == 0 ? std::numeric_limits<double>::infinity() : feed);
  if (has_axis && motion_ >= 2) {
    const auto [first, second] = axes_of_plane(plane_);
    words.arc = {.first = first,
                 .second = second,
                 .first_center = center[first],
                 .second_center = center[second],
                 .clockwise = motion_ == 2};
  }
  const double answered = run(hindered_, words, Seconds(arrival(text.size() + 1))).value();
  unanswered_.back().answered = answered_ = answered;
  answered_unhindered_ = run(unhindered_, words, Seconds(answered_unhindered_)).value();
  weigh(text.size() + 1, std::sqrt(length2), source);
  at_ = words.end;
}

Seconds GrblForecast::run(GrblPlanner& planner, const Words& words, Seconds when) const {
  if (words.kind == Words::Kind::rest) return planner.wait_for_rest(words.dwell, when);
  if (words.kind == Words::Kind::modes) return when;
  if (words.arc) return planner.add_arc(*words.arc, words.end, words.feed, words.source, when);
  return planner.add_line(words.end, words.feed, words.source, when);
}

// When the last byte of a line of this size has arrived. It is sent when the receive buffer has room for it.
double GrblForecast::arrival(std::size_t bytes) {
  double sent = free_at_;
  while (!unanswered_.empty() && unanswered_bytes_ + bytes > line_.buffer) {
    sent = std::max(sent, unanswered_.front().answered);
    unanswered_bytes_ -= unanswered_.front().bytes;
    unanswered_.pop_front();
  }
  if (line_.bytes_per_second > 0) sent += static_cast<double>(bytes) / line_.bytes_per_second;
  unanswered_.push_back({.bytes = bytes});
  unanswered_bytes_ += bytes;
  free_at_ = sent;
  return std::max(sent, answered_);
}

// Finds the stretch of lines with the least motion per byte.
void GrblForecast::weigh(std::size_t bytes, double length, std::uint32_t source) {
  if (line_.bytes_per_second <= 0) return;
  window_.push_back({.bytes = static_cast<double>(bytes), .length = length, .source = source});
  window_bytes_ += static_cast<double>(bytes);
  window_length_ += length;
  const double wanted = stretch_time * line_.bytes_per_second;
  while (window_.size() > 1 && (window_bytes_ - window_.front().bytes >= wanted || window_.size() > most_lines)) {
    window_bytes_ -= window_.front().bytes;
    window_length_ -= window_.front().length;
    window_.pop_front();
  }
  if (window_bytes_ < wanted || window_length_ <= 0) return;
  const double carried = window_length_ / (window_bytes_ / line_.bytes_per_second);
  if (result_.feed_carried > MmPerSecond(0) && carried >= result_.feed_carried.value()) return;
  result_.feed_carried = MmPerSecond(carried);
  result_.densest_line = window_.front().source;
}

GrblForecast::Result GrblForecast::finish() {
  result_.time = hindered_.wait_for_rest(Seconds(0), Seconds(answered_));
  result_.unhindered = unhindered_.wait_for_rest(Seconds(0), Seconds(answered_unhindered_));
  return result_;
}

}  // namespace passo
