#include "chart.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "axis_ticks.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using namespace sheet;

// The place of a value on its axis, from 0 to 1.
double share(const Chart::Axis& axis, double value) {
  if (axis.logarithmic) return std::log10(value / axis.begin) / std::log10(axis.end / axis.begin);
  return (value - axis.begin) / (axis.end - axis.begin);
}

// A logarithmic axis has a tick for each power of ten. Any other axis has as many ticks as fit.
std::vector<Tick> ticks_of(const Chart::Axis& axis, double length,
                           const std::function<double(const std::string&)>& room) {
  if (!axis.logarithmic) return ticks(axis.begin, axis.end, length / (axis.end - axis.begin), room);
  std::vector<Tick> all;
  for (double value = axis.begin; value < axis.end * 1.5; value *= 10) {
    all.push_back({value, fmt::format("{:.12g}", value)});
  }
  return all;
}

}  // namespace

double axis_end(double least) {
  if (!(least > 0) || !std::isfinite(least)) return 1;
  const double step = round_step(least / 8);
  return step * std::ceil(least / step * (1 - 1e-9));
}

Chart::Chart(Canvas& canvas, const Area& area, Axis x, Axis y)
    : canvas_(canvas), area_(area), x_(std::move(x)), y_(std::move(y)) {}

Spot Chart::at(double x, double y) const {
  return {area_.x + share(x_, x) * area_.width, area_.bottom() - share(y_, y) * area_.height};
}

void Chart::draw_grid(bool x_labels) {
  canvas_.fill(area_, paper);
  const auto width = [&](const std::string& text) { return canvas_.text_width(text, label) + 28; };
  const auto height = [](const std::string&) { return 34.0; };
  for (const Tick& tick : ticks_of(x_, area_.width, width)) {
    const double x = at(tick.value, y_.begin).x;
    canvas_.line({x, area_.y}, {x, area_.bottom()}, grid);
    if (!x_labels) continue;
    canvas_.line({x, area_.bottom()}, {x, area_.bottom() + mark}, edge);
    canvas_.text({x, area_.bottom() + mark + 11}, tick.label, label, Align::centre);
  }
  for (const Tick& tick : ticks_of(y_, area_.height, height)) {
    const double y = at(x_.begin, tick.value).y;
    canvas_.line({area_.x, y}, {area_.right(), y}, grid);
    canvas_.line({area_.x - mark, y}, {area_.x, y}, edge);
    canvas_.text({area_.x - mark - 5, y}, tick.label, label, Align::right);
  }
  if (x_labels) canvas_.text({area_.x + area_.width / 2, area_.bottom() + 38}, x_.title, axis_title, Align::centre);
  canvas_.text({area_.x, area_.y - 16}, y_.title, axis_title);
}

void Chart::draw_upper_scale(const std::string& title, double x_per_unit) {
  const auto width = [&](const std::string& text) { return canvas_.text_width(text, label) + 40; };
  const double end = x_.end / x_per_unit;
  const double title_left = area_.right() - canvas_.text_width(title, axis_title);
  canvas_.text({area_.right(), area_.y - 34}, title, axis_title, Align::right);
  // The left end of the edge is left free for the title of the other axis.
  const double free_left = area_.x + canvas_.text_width(y_.title, axis_title) + 24;
  for (const Tick& tick : ticks(0, end, area_.width / end, width)) {
    const double x = at(tick.value * x_per_unit, 0).x;
    canvas_.line({x, area_.y - mark}, {x, area_.y}, edge);
    if (x < free_left || (title_left < area_.x)) continue;
    canvas_.text({x, area_.y - mark - 9}, tick.label, label, Align::centre);
  }
}

void Chart::draw_frame() {
  canvas_.frame(area_, edge);
}

std::vector<Spot> Chart::spots(const Function& function, double end) const {
  std::vector<Spot> all;
  const double last = std::min(end, x_.end);
  // The points are so close that the eye sees a curve. The end is one of the points, because a curve may stop there
  // with a step.
  constexpr double distance = 2;
  const int count = std::max(1, static_cast<int>(std::ceil(area_.width * last / x_.end / distance)));
  for (int i = 0; i <= count; ++i) {
    const double x = x_.begin + (last - x_.begin) * i / count;
    all.push_back(at(x, std::clamp(function(x), y_.begin, y_.end)));
  }
  return all;
}

void Chart::fill_between(const Function& lower, const Function& upper, double end, const Colour& colour,
                         double opacity) {
  std::vector<Spot> polygon = spots(upper, end);
  const std::vector<Spot> below = spots(lower, end);
  polygon.insert(polygon.end(), below.rbegin(), below.rend());
  canvas_.fill(polygon, colour, opacity);
}

void Chart::curve(const Function& function, const Pen& pen, double end) {
  const std::vector<Spot> all = spots(function, end);
  canvas_.move_to(all.front());
  for (std::size_t i = 1; i < all.size(); ++i) canvas_.line_to(all[i]);
  canvas_.stroke(pen);
}

void Chart::polyline(const std::vector<Spot>& values, const Pen& pen) {
  bool first = true;
  for (const Spot& value : values) {
    const Spot spot = at(std::clamp(value.x, x_.begin, x_.end), std::clamp(value.y, y_.begin, y_.end));
    first ? canvas_.move_to(spot) : canvas_.line_to(spot);
    first = false;
  }
  canvas_.stroke(pen);
}

}  // namespace passo
