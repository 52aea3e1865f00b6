#include "passo/report/ramp_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using namespace sheet;
// With more intervals than this, single intervals cannot be told apart.
constexpr std::size_t most_single = 120;

// Everyone can tell blue, orange and green apart. The first curve is broad and pale, so that it stays visible under the
// others.
const std::array<Pen, 3> trace_pens = {Pen{.colour = {0.52, 0.70, 0.90}, .width = 5},
                                       Pen{.colour = {0.80, 0.40, 0.05}, .width = 2},
                                       Pen{.colour = {0.05, 0.42, 0.25}, .width = 1.4}};
const Pen ideal_pen{.colour = {0.35, 0.37, 0.40}, .width = 1.2, .dashes = {7, 5}};
const Pen one_tick_pen{.colour = {0.45, 0.47, 0.50}, .width = 1, .dashes = {2, 4}};
const Pen planned_acceleration_pen{.colour = {0.55, 0.20, 0.45}, .width = 2.2};
constexpr double least_error = 0.001;  // ticks

struct RampExtent {
  double time = 0;   // s
  double steps = 0;  // the last index
  double rate = 0;
  double ticks = 0;
  double least_ticks = HUGE_VAL;
  double error = 1;
  bool back = false;  // some steps go back
};

RampExtent extent_of(const RampScene& scene) {
  RampExtent extent;
  for (const RampTrace& trace : scene.traces) {
    for (const RampSample& sample : trace.samples) {
      extent.time = std::max(extent.time, sample.end);
      extent.steps = std::max(extent.steps, sample.n);
      extent.rate = std::max(extent.rate, 1 / (sample.ticks * scene.tick));
      extent.ticks = std::max(extent.ticks, sample.ticks);
      extent.least_ticks = std::min(extent.least_ticks, sample.ticks);
      extent.error = std::max(extent.error, std::abs(sample.error));
      extent.back = extent.back || sample.back;
    }
  }
  for (const RampPoint& point : scene.ideal) extent.rate = std::max(extent.rate, std::abs(point.value));
  return extent;
}

// Short moves are shown in milliseconds, long ones in seconds.
double per_second(double time) {
  return time < 2 ? 1000 : 1;
}

bool single(const RampScene& scene) {
  return !scene.traces.empty() && scene.traces.front().samples.size() <= most_single;
}

void draw_rates(Canvas& canvas, const Area& area, const RampScene& scene, const RampExtent& extent) {
  const double scale = per_second(extent.time);
  const double most = axis_end(extent.rate * 1.02);
  Chart chart(canvas, area, {.title = scale > 1 ? "Time, ms" : "Time, s", .end = axis_end(extent.time * scale)},
              {.title = "Rate, steps/s", .end = most, .begin = extent.back ? -most : 0});
  chart.draw_grid();
  std::vector<Spot> ideal;
  for (const RampPoint& point : scene.ideal) ideal.push_back({point.time * scale, point.value});
  for (std::size_t i = 0; i < scene.traces.size(); ++i) {
    std::vector<Spot> line;
    for (const RampSample& sample : scene.traces[i].samples) {
      const double rate = (sample.back ? -1 : 1) / (sample.ticks * scene.tick);
      if (single(scene)) {  // a stair: the mean rate of each step
        line.push_back({sample.begin * scale, rate});
        line.push_back({sample.end * scale, rate});
      } else {
        line.push_back({(sample.begin + sample.end) / 2 * scale, rate});
      }
    }
    chart.polyline(line, trace_pens[i]);
  }
  chart.polyline(ideal, ideal_pen);
  chart.draw_frame();
}

void draw_dots(Canvas& canvas, const Chart& chart, const std::vector<Spot>& values, double radius,
               const Colour& colour) {
  for (const Spot& value : values) canvas.disc(chart.at(value.x, value.y), radius, colour);
}
double radius_of(const Pen& pen) {
  return 1.4 + pen.width * 0.7;
}

double power_below(double value) {
  return std::pow(10, std::floor(std::log10(value) + 1e-9));
}
double power_above(double value) {
  return std::pow(10, std::ceil(std::log10(value) - 1e-9));
}

void draw_intervals(Canvas& canvas, const Area& area, const RampScene& scene, const RampExtent& extent) {
  const double low = power_below(std::max(extent.least_ticks, 1.0));
  Chart chart(canvas, area, {.title = "Step", .end = axis_end(std::max(extent.steps, 1.0))},
              {.title = "Interval, ticks",
               .end = std::max(power_above(extent.ticks), 10 * low),
               .begin = low,
               .logarithmic = true});
  chart.draw_grid();
  for (std::size_t i = 0; i < scene.traces.size(); ++i) {
    std::vector<Spot> line;
    for (const RampSample& sample : scene.traces[i].samples) line.push_back({sample.n, std::max(sample.ticks, low)});
    chart.polyline(line, trace_pens[i]);
    if (single(scene)) draw_dots(canvas, chart, line, radius_of(trace_pens[i]), trace_pens[i].colour);
  }
  chart.draw_frame();
}

// Whether errors are drawn as a line. A rounding error jumps from step to step, and a line would fill the whole band.
// Dots show the band better.
bool smooth_errors(const RampTrace& trace) {
  return std::ranges::any_of(trace.samples, [](const RampSample& sample) { return std::abs(sample.error) > 3; });
}

void draw_errors(Canvas& canvas, const Area& area, const RampScene& scene, const RampExtent& extent) {
  const double steps = axis_end(std::max(extent.steps, 1.0));
  Chart chart(canvas, area, {.title = "Step", .end = steps},
              {.title = "Error of the interval, ticks",
               .end = std::max(power_above(extent.error), 10.0),
               .begin = least_error,
               .logarithmic = true});
  chart.draw_grid();
  chart.polyline({{0, 1}, {steps, 1}}, one_tick_pen);
  for (std::size_t i = 0; i < scene.traces.size(); ++i) {
    const Pen& pen = trace_pens[i];
    const bool smooth = smooth_errors(scene.traces[i]);
    std::vector<Spot> line;
    for (const RampSample& sample : scene.traces[i].samples) {
      const double error = std::abs(sample.error);
      if (error >= least_error) line.push_back({sample.n, error});
      // An error of 0 has no place on a logarithmic scale, so the line ends there and begins anew after it.
      if (error >= least_error && &sample != &scene.traces[i].samples.back()) continue;
      if (smooth && line.size() > 1) chart.polyline(line, pen);
      if (smooth) line.clear();
    }
    if (!smooth) draw_dots(canvas, chart, line, single(scene) ? radius_of(pen) : 1.6 + pen.width * 0.1, pen.colour);
  }
  chart.draw_frame();
}

void draw_acceleration(Canvas& canvas, const Area& area, const RampScene& scene, const RampExtent& extent) {
  const double scale = per_second(extent.time);
  double most = 0;
  std::vector<Spot> line;
  for (const RampPoint& point : scene.acceleration) {
    most = std::max(most, std::abs(point.value));
    line.push_back({point.time * scale, point.value});
  }
  const double end = axis_end(most * 1.05);
  Chart chart(canvas, area, {.title = scale > 1 ? "Time, ms" : "Time, s", .end = axis_end(extent.time * scale)},
              {.title = "Acceleration at the steps, rad/s\u00B2", .end = end, .begin = -end});
  chart.draw_grid();
  chart.polyline({{0, 0}, {axis_end(extent.time * scale), 0}}, one_tick_pen);
  chart.polyline(line, planned_acceleration_pen);
  chart.draw_frame();
}

void draw_legend(Canvas& canvas, const RampScene& scene, Spot place) {
  Legend legend(canvas, place);
  for (std::size_t i = 0; i < scene.traces.size(); ++i) legend.line(trace_pens[i], scene.traces[i].name);
  if (!scene.ideal.empty()) legend.line(ideal_pen, scene.ideal_name);
}

}  // namespace

Status<OutputError> draw_ramp_picture(const RampScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  begin_sheet(canvas, options);

  const RampExtent extent = extent_of(scene);
  constexpr double left = margin + 52;
  constexpr double upper = 138;
  constexpr double between = 96;
  const double bottom = height - 128;
  const double wide = 0.56 * (width - left - margin);
  const Area rates{left, upper, wide, bottom - upper};
  const double right = rates.right() + 92;
  const double tall = (bottom - upper - between) / 2;
  const Area intervals{right, upper, width - margin - right, tall};
  const Area lower{right, upper + tall + between, intervals.width, tall};
  draw_rates(canvas, rates, scene, extent);
  draw_intervals(canvas, intervals, scene, extent);
  if (scene.acceleration.empty()) {
    draw_errors(canvas, lower, scene, extent);
  } else {
    draw_acceleration(canvas, lower, scene, extent);
  }
  draw_legend(canvas, scene, {left, height - 42});
  return canvas.finish();
}

}  // namespace passo
