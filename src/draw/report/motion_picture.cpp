#include "passo/report/motion_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"

namespace passo {
namespace {

const Colour tolerance_colour{0.90, 0.93, 0.97};
const Pen programmed_pen{.colour = {0.45, 0.47, 0.50}, .width = 1.2, .dashes = {7, 5}};
const Pen path_pen{.colour = {0.80, 0.40, 0.05}, .width = 2.2};
const Pen speed_pen{.colour = {0.10, 0.33, 0.60}, .width = 2.4};
const Pen cap_pen{.colour = {0.45, 0.47, 0.50}, .width = 1.4, .dashes = {7, 5}};
const Colour cell_colour{0.10, 0.33, 0.60};
// Everyone can tell blue, orange and green apart.
const std::array<Pen, 3> axis_pens = {Pen{.colour = {0.10, 0.33, 0.60}, .width = 2.2},
                                      Pen{.colour = {0.80, 0.40, 0.05}, .width = 2.2},
                                      Pen{.colour = {0.05, 0.42, 0.25}, .width = 2.2}};
using namespace sheet;
constexpr double top = 120;
constexpr double room = 1.08;  // above the greatest value
// With more cells than this, single cells cannot be told apart.
constexpr std::size_t most_dots = 250;

struct Peaks {
  double time = 0;
  double way = 0;
  double speed = 0;
  double jerk_limit = 0;
  double acceleration_limit = 0;
  std::size_t phases = 0;
  std::vector<Axis> axes;  // those that move, three at most
};

Peaks peaks_of(const MotionRecorder& motion) {
  Peaks peaks;
  for (const MotionSample& sample : motion.samples()) {
    peaks.time = sample.time;
    peaks.way = std::max(peaks.way, sample.way);
    peaks.speed = std::max(peaks.speed, sample.speed);
    peaks.phases += sample.begins_phase ? 1 : 0;
  }
  for (const Axis axis : all_axes) {
    const auto moves = [axis](const MotionSample& sample) { return std::abs(sample.acceleration[axis]) > 1e-9; };
    if (peaks.axes.size() == axis_pens.size() || std::ranges::none_of(motion.samples(), moves)) continue;
    peaks.axes.push_back(axis);
    peaks.acceleration_limit = std::max(peaks.acceleration_limit, motion.limits().acceleration[axis].value());
    peaks.jerk_limit = std::max(peaks.jerk_limit, motion.limits().jerk[axis].value());
  }
  return peaks;
}

// The path from above, with the same scale along both axes.
class PathView {
 public:
  PathView(Canvas& canvas, const Area& area, const MotionRecorder& motion)
      : canvas_(canvas), area_(area), motion_(motion) {
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;
    for (const MotionRecorder::ProgrammedPiece& piece : motion.programmed()) {
      for (const Point& place : {piece.from, piece.to}) {
        low_x = std::min(low_x, place[Axis::x] - 2 * piece.tolerance);
        high_x = std::max(high_x, place[Axis::x] + 2 * piece.tolerance);
        low_y = std::min(low_y, place[Axis::y] - 2 * piece.tolerance);
        high_y = std::max(high_y, place[Axis::y] + 2 * piece.tolerance);
      }
    }
    scale_ = std::min(area.width / std::max(high_x - low_x, 1e-9), area.height / std::max(high_y - low_y, 1e-9));
    middle_x_ = (low_x + high_x) / 2;
    middle_y_ = (low_y + high_y) / 2;
  }

  void draw() {
    canvas_.fill(area_, paper);
    canvas_.clip(area_);
    for (const MotionRecorder::ProgrammedPiece& piece : motion_.programmed()) draw_tube(piece);
    for (const MotionRecorder::ProgrammedPiece& piece : motion_.programmed()) {
      canvas_.line(spot(piece.from), spot(piece.to), programmed_pen);
    }
    bool first = true;
    for (const MotionSample& sample : motion_.samples()) {
      first ? canvas_.move_to(spot(sample.place)) : canvas_.line_to(spot(sample.place));
      first = false;
    }
    canvas_.stroke(path_pen);
    canvas_.end_clip();
    canvas_.frame(area_, {.colour = {0.62, 0.64, 0.67}, .width = 1});
  }

 private:
  Spot spot(const Point& place) const {
    return {area_.x + area_.width / 2 + (place[Axis::x] - middle_x_) * scale_,
            area_.y + area_.height / 2 - (place[Axis::y] - middle_y_) * scale_};
  }
  void draw_tube(const MotionRecorder::ProgrammedPiece& piece) {
    const Spot from = spot(piece.from);
    const Spot to = spot(piece.to);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const double radius = piece.tolerance * scale_;
    canvas_.disc(from, radius, tolerance_colour);
    canvas_.disc(to, radius, tolerance_colour);
    if (!(length > 0)) return;
    const double x = -(to.y - from.y) / length * radius;
    const double y = (to.x - from.x) / length * radius;
    canvas_.fill({{from.x + x, from.y + y}, {to.x + x, to.y + y}, {to.x - x, to.y - y}, {from.x - x, from.y - y}},
                 tolerance_colour);
  }

  Canvas& canvas_;
  Area area_;
  const MotionRecorder& motion_;
  double scale_ = 1;
  double middle_x_ = 0;
  double middle_y_ = 0;
};

void draw_speed(Canvas& canvas, const Area& area, const MotionRecorder& motion, const Peaks& peaks) {
  Chart chart(canvas, area, {.title = "Distance, mm", .end = axis_end(peaks.way)},
              {.title = "Speed along the path, mm/s", .end = axis_end(1.3 * peaks.speed)});
  chart.draw_grid();
  std::vector<Spot> caps;
  std::vector<Spot> speeds;
  for (const MotionSample& sample : motion.samples()) {
    caps.push_back({sample.way, sample.cap});
    speeds.push_back({sample.way, sample.speed});
  }
  chart.polyline(caps, cap_pen);
  chart.polyline(speeds, speed_pen);
  if (peaks.phases <= most_dots) {
    for (const MotionSample& sample : motion.samples()) {
      if (sample.begins_phase) canvas.disc(chart.at(sample.way, sample.speed), 3, cell_colour);
    }
  }
  chart.draw_frame();
}

struct Quantity {  // of an axis, over time
  std::string title;
  double limit = 0;
  bool labels = true;
  Point MotionSample::*values;
};

void draw_axes(Canvas& canvas, const Area& area, const MotionRecorder& motion, const Peaks& peaks,
               const Quantity& quantity) {
  double most = quantity.limit;
  for (const MotionSample& sample : motion.samples()) {
    for (const Axis axis : peaks.axes) most = std::max(most, std::abs((sample.*quantity.values)[axis]));
  }
  const double end = axis_end(room * most);
  Chart chart(canvas, area, {.title = "Time, s", .end = axis_end(peaks.time)},
              {.title = quantity.title, .end = end, .begin = -end});
  chart.draw_grid(quantity.labels);
  const double last = axis_end(peaks.time);
  chart.polyline({{0, 0}, {last, 0}}, edge);
  if (quantity.limit > 0) {
    chart.polyline({{0, quantity.limit}, {last, quantity.limit}}, cap_pen);
    chart.polyline({{0, -quantity.limit}, {last, -quantity.limit}}, cap_pen);
  }
  for (std::size_t i = 0; i < peaks.axes.size(); ++i) {
    std::vector<Spot> values;
    for (const MotionSample& sample : motion.samples()) {
      values.push_back({sample.time, (sample.*quantity.values)[peaks.axes[i]]});
    }
    chart.polyline(values, axis_pens[i]);
  }
  chart.draw_frame();
}

void draw_legend(Canvas& canvas, const Peaks& peaks, Spot place) {
  Legend legend(canvas, place);
  legend.patch(tolerance_colour, "within the tolerance");
  legend.line(programmed_pen, "programmed; limits");
  legend.line(path_pen, "planned path");
  if (peaks.phases <= most_dots) legend.dot(3, cell_colour, "start of a phase");
  for (std::size_t i = 0; i < peaks.axes.size(); ++i) {
    legend.line(axis_pens[i], std::string("axis ") + letter_of(peaks.axes[i]));
  }
}

}  // namespace

Status<OutputError> draw_motion_picture(const MotionRecorder& motion, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  begin_sheet(canvas, options);
  const Peaks peaks = peaks_of(motion);
  const double bottom = height - 110;
  PathView(canvas, {margin, top, 0.4 * width - margin, bottom - top}, motion).draw();

  const double left = 0.4 * width + 110;
  const double charts = peaks.jerk_limit > 0 ? 3 : 2;
  constexpr double gap = 92;
  const double chart_height = (bottom - top - (charts - 1) * gap) / charts;
  Area area{left, top, width - left - margin, chart_height};
  draw_speed(canvas, area, motion, peaks);
  area.y += chart_height + gap;
  draw_axes(canvas, area, motion, peaks,
            {.title = "Acceleration of the axes, mm/s\u00B2",
             .limit = peaks.acceleration_limit,
             .labels = true,
             .values = &MotionSample::acceleration});
  if (peaks.jerk_limit > 0) {
    area.y += chart_height + gap;
    draw_axes(canvas, area, motion, peaks,
              {.title = "Jerk of the axes, mm/s\u00B3",
               .limit = peaks.jerk_limit,
               .labels = true,
               .values = &MotionSample::jerk});
  }
  draw_legend(canvas, peaks, {margin, height - 40});
  return canvas.finish();
}

}  // namespace passo
