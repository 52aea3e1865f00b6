#include "passo/report/chord_picture.hpp"

#include <cmath>
#include <string>

#include "axis_ticks.hpp"
#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using namespace sheet;
const Colour tube_colour{0.86, 0.92, 0.98};
const Colour chord_colour{0.12, 0.36, 0.75};
const Colour limit_colour{0.82, 0.22, 0.20};
const Pen curve_pen{.colour = ink, .width = 1.1};
const Pen chord_pen{.colour = chord_colour, .width = 1.4};
const Pen tube_pen{.colour = tube_colour, .width = 14};
const Pen limit_pen{.colour = limit_colour, .width = 1.2, .opacity = 1, .dashes = {7, 5}};

double distance(const ChordDrawing::Sample& sample) {
  return length(sample.curve - sample.chord);
}

// Converts values of one axis to the picture. Values grow to the right or upwards.
struct Scale {
  double low = 0;
  double high = 1;
  double origin = 0;  // where `low` is drawn
  double pixels = 1;  // for one unit; negative if values grow upwards
  double operator()(double value) const { return origin + (value - low) * pixels; }
};

// The factor by which the tube is widened so that it can be seen: a round number, or 1.
double exaggeration_for(const ChordDrawing& drawing, double pixels_per_mm) {
  constexpr double half_width = 14;
  const double most = half_width / (drawing.tolerance.value() * pixels_per_mm);
  if (most <= 1) return 1;
  const double decade = std::pow(10, std::floor(std::log10(most)));
  return (most >= 5 * decade ? 5 : most >= 2 * decade ? 2 : 1) * decade;
}

// A view along one axis: the coordinate that points right, and the coordinate that points up.
struct View {
  std::string name;
  double Vector3::*right;
  double Vector3::*up;
  std::string right_name;
  std::string up_name;
};
const View top_view{"Top view", &Vector3::x, &Vector3::y, "X, mm", "Y, mm"};
const View front_view{"Front view", &Vector3::x, &Vector3::z, "X, mm", "Z, mm"};

struct Extent {
  double low = 0;
  double high = 0;
};

Extent extent_of(const ChordDrawing& drawing, double Vector3::*axis) {
  Extent extent{drawing.ends.front().*axis, drawing.ends.front().*axis};
  for (const ChordDrawing::Sample& sample : drawing.samples) {
    extent.low = std::min(extent.low, sample.curve.*axis);
    extent.high = std::max(extent.high, sample.curve.*axis);
  }
  return extent;
}

// Both axes have the same scale, and the curve is in the middle. If there is more room, more of the plane is shown.
struct ViewFrame {
  Area area;
  Scale right;
  Scale up;
  Spot spot(const View& view, const Vector3& place) const { return {right(place.*view.right), up(place.*view.up)}; }
};

ViewFrame fitted(const ChordDrawing& drawing, const View& view, const Area& area) {
  const Extent x = extent_of(drawing, view.right);
  const Extent y = extent_of(drawing, view.up);
  constexpr double inside = 44;  // free space on all sides, for the tube and the points
  const double least = 1e-9;
  double scale = std::min((area.width - 2 * inside) / std::max(x.high - x.low, least),
                          (area.height - 2 * inside) / std::max(y.high - y.low, least));
  if (x.high - x.low < least && y.high - y.low < least) scale = 20;
  const double wide = area.width / scale;
  const double high = area.height / scale;
  const double left = (x.low + x.high - wide) / 2;
  const double lower = (y.low + y.high - high) / 2;
  return {area, {left, left + wide, area.x, scale}, {lower, lower + high, area.bottom(), -scale}};
}

void draw_horizontal_ticks(Canvas& canvas, const Scale& scale, const Area& area) {
  const auto room = [&](const std::string& text) { return canvas.text_width(text, label) + 24; };
  for (const Tick& tick : ticks(scale.low, scale.high, scale.pixels, room)) {
    const double x = scale(tick.value);
    canvas.line({x, area.y}, {x, area.bottom()}, grid);
    canvas.line({x, area.bottom()}, {x, area.bottom() + 5}, edge);
    canvas.text({x, area.bottom() + 16}, tick.label, label, Align::centre);
  }
}

void draw_vertical_ticks(Canvas& canvas, const Scale& scale, const Area& area) {
  const auto room = [](const std::string&) { return 26.0; };
  for (const Tick& tick : ticks(scale.low, scale.high, -scale.pixels, room)) {
    const double y = scale(tick.value);
    canvas.line({area.x, y}, {area.right(), y}, grid);
    canvas.line({area.x - 5, y}, {area.x, y}, edge);
    canvas.text({area.x - 9, y}, tick.label, label, Align::right);
  }
}

template <class Place>
void draw_polyline(Canvas& canvas, const ChordDrawing& drawing, const Pen& pen, Place place) {
  if (drawing.samples.empty()) return;
  canvas.move_to(place(drawing.samples.front()));
  for (const ChordDrawing::Sample& sample : drawing.samples) canvas.line_to(place(sample));
  canvas.stroke(pen);
}

void draw_ends(Canvas& canvas, const ChordDrawing& drawing, const View& view, const ViewFrame& frame) {
  double way = 0;
  for (std::size_t i = 1; i < drawing.ends.size(); ++i) {
    way += length(drawing.ends[i] - drawing.ends[i - 1]) * frame.right.pixels;
  }
  // Points that are too close to each other would hide the curve.
  const double apart = way / static_cast<double>(std::max<std::size_t>(1, drawing.ends.size() - 1));
  if (apart < 7 && drawing.ends.size() > 2) return;
  const double radius = std::min(3.6, apart / 5);
  for (const Vector3& end : drawing.ends) canvas.disc(frame.spot(view, end), radius, chord_colour);
}

void draw_view(Canvas& canvas, const ChordDrawing& drawing, const View& view, const Area& area, double factor) {
  const ViewFrame frame = fitted(drawing, view, area);
  canvas.text({area.x + area.width / 2, area.y - 16}, view.name, axis_title, Align::centre);
  draw_horizontal_ticks(canvas, frame.right, area);
  draw_vertical_ticks(canvas, frame.up, area);
  const auto on_curve = [&](const ChordDrawing::Sample& sample) { return frame.spot(view, sample.curve); };
  const auto on_chord = [&](const ChordDrawing::Sample& sample) {
    return frame.spot(view, sample.curve + (sample.chord - sample.curve) * factor);
  };
  const double half_width = drawing.tolerance.value() * factor * frame.right.pixels;
  // A tube need not be drawn wider than the picture.
  const double shown = std::min(half_width, area.height);
  canvas.clip(area);
  draw_polyline(canvas, drawing, {.colour = tube_colour, .width = 2 * shown}, on_curve);
  draw_polyline(canvas, drawing, curve_pen, on_curve);
  draw_polyline(canvas, drawing, chord_pen, on_chord);
  draw_ends(canvas, drawing, view, frame);
  canvas.end_clip();
  canvas.frame(area, edge);
  canvas.text({area.x + area.width / 2, area.bottom() + 36}, view.right_name, axis_title, Align::centre);
  canvas.text({area.x - 9, area.y - 16}, view.up_name, axis_title, Align::right);
}

double path_length(const ChordDrawing& drawing) {
  double sum = 0;
  for (std::size_t i = 1; i < drawing.samples.size(); ++i) {
    sum += length(drawing.samples[i].curve - drawing.samples[i - 1].curve);
  }
  return sum;
}

double farthest(const ChordDrawing& drawing) {
  double most = 0;
  for (const ChordDrawing::Sample& sample : drawing.samples) most = std::max(most, distance(sample));
  return most;
}

// Draws the distance of the chords from the curve along the curve's length, with the tolerance as a line above.
void draw_deviation(Canvas& canvas, const ChordDrawing& drawing, const Area& area) {
  const bool small = drawing.tolerance < Mm(0.5);
  const double unit = small ? 1000 : 1;
  const double limit = drawing.tolerance.value() * unit;
  const double whole = std::max(path_length(drawing), 1e-9);
  Chart chart(canvas, area, {"Along the curve, mm", whole},
              {small ? "Distance of the chords from the curve, \u00B5m" : "Distance of the chords from the curve, mm",
               limit * 1.25});
  chart.draw_grid();
  std::vector<Spot> hills = {chart.at(0, 0)};
  double way = 0;
  const ChordDrawing::Sample* before = nullptr;
  for (const ChordDrawing::Sample& sample : drawing.samples) {
    if (before != nullptr) way += length(sample.curve - before->curve);
    hills.push_back(chart.at(way, distance(sample) * unit));
    before = &sample;
  }
  hills.push_back(chart.at(way, 0));
  canvas.fill(hills, tube_colour);
  canvas.move_to(hills.front());
  for (const Spot& spot : hills) canvas.line_to(spot);
  canvas.stroke(chord_pen);
  canvas.line(chart.at(0, limit), chart.at(whole, limit), limit_pen);
  chart.draw_frame();
}

std::string factor_text(double factor) {
  return factor == 1 ? "to scale" : fmt::format("widened {:g} \u00D7", factor);
}

void draw_legend(Canvas& canvas, const ChordDrawing& drawing, double factor, double right, double y) {
  const std::string times = factor == 1 ? "" : fmt::format(", distance from the curve enlarged {:g} \u00D7", factor);
  const std::string limit = drawing.chord_length ? "Greatest distance" : "Tolerance";
  const std::array<const Pen*, 4> pens = {&curve_pen, &chord_pen, &tube_pen, &limit_pen};
  const std::vector<std::string> words = {"Curve", "Chords" + times, limit + ", " + factor_text(factor), limit};
  Legend legend(canvas, {right - Legend::width_of_lines(canvas, words), y});
  for (std::size_t i = 0; i < pens.size(); ++i) legend.line(*pens[i], words[i]);
}

std::string mm_text(double mm) {
  return fmt::format("{:.4g} mm", mm);
}

// What decided the length of the chords.
std::string choice_text(const ChordDrawing& drawing) {
  if (drawing.chord_length) return mm_text(drawing.chord_length->value()) + " each";
  return "tolerance " + mm_text(drawing.tolerance.value());
}

}  // namespace

Status<OutputError> draw_chords(const ChordDrawing& drawing, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  const std::size_t count = drawing.ends.size() - 1;
  begin_sheet(canvas, options,
              fmt::format("{} {}   \u00B7   {}   \u00B7   at most {} from the curve   \u00B7   {} long", count,
                          count == 1 ? "chord" : "chords", choice_text(drawing), mm_text(farthest(drawing)),
                          mm_text(path_length(drawing))));

  constexpr double left = margin + 40;
  constexpr double upper = 132;
  const double views_height = height - 458;
  const double whole_width = width - left - margin;
  const Extent z = extent_of(drawing, &Vector3::z);
  const bool flat = z.high - z.low < 1e-9;
  const double view_width = flat ? whole_width : (whole_width - 90) / 2;
  const Area first{left, upper, view_width, views_height};
  const Area second{left + view_width + 90, upper, view_width, views_height};
  double pixels = fitted(drawing, top_view, first).right.pixels;
  if (!flat) pixels = std::min(pixels, fitted(drawing, front_view, second).right.pixels);
  const double factor = exaggeration_for(drawing, pixels);
  draw_view(canvas, drawing, top_view, first, factor);
  if (!flat) draw_view(canvas, drawing, front_view, second, factor);
  const double strip = upper + views_height + 106;
  draw_legend(canvas, drawing, factor, width - margin, strip - 20);
  draw_deviation(canvas, drawing, {left, strip, whole_width, height - strip - 62});
  return canvas.finish();
}

}  // namespace passo
