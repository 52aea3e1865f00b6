#include "passo/sender/grbl_forecast.hpp"

#include <algorithm>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// A stretch of lines that takes the connection so long tells the feed that it carries; shorter ones lie in the buffers.
constexpr double stretch_time = 1;         // s
constexpr std::size_t most_lines = 20000;  // of a stretch

// The first settings of each kind; that of the next axis follows.
constexpr int steps_per_mm = 100;
constexpr int velocity = 110;
constexpr int acceleration = 120;

}  // namespace

GrblLimits limits_of(const GrblMachine& machine) {
  const auto setting = [&](int number, double fallback) {
    const auto found = machine.settings.find(number);
    return found == machine.settings.end() ? fallback : found->second;
  };
  GrblLimits limits{.junction_deviation = Mm(std::max(0.0, setting(11, 0.01))),
                    .arc_tolerance = Mm(setting(12, 0.002)),
                    .blocks = machine.blocks,
                    .core_xy = machine.is_core_xy(),
                    .feeds_tool = !machine.measures_motors()};
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
    : limits_(limits), line_(line), reader_(start, target.zero), hindered_(limits, start), unhindered_(limits, start) {}

void GrblForecast::add(std::string_view text, std::uint32_t source) {
  GrblLineMotion line = reader_.read(text);
  const Point way = line.end - line.start;
  const double length = length_of(way);
  // In inverse time the way does not matter.
  if (reader_.modes().by_time && length > 0 && !limits_.feeds_tool)
    line.feed = line.feed * (length_of(limits_.measured(way)) / length);
  const double answered = run(hindered_, line, source, Seconds(arrival(text.size() + 1))).value();
  unanswered_.back().answered = answered_ = answered;
  answered_unhindered_ = run(unhindered_, line, source, Seconds(answered_unhindered_)).value();
  weigh(text.size() + 1, length, source);
}

Seconds GrblForecast::run(GrblPlanner& planner, const GrblLineMotion& line, std::uint32_t source, Seconds when) {
  if (line.kind == GrblLineMotion::Kind::rest) return planner.wait_for_rest(line.dwell, when);
  if (line.kind != GrblLineMotion::Kind::move) return when;
  if (line.arc) return planner.add_arc(*line.arc, line.end, line.feed, source, when);
  return planner.add_line(line.end, line.feed, source, when);
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
