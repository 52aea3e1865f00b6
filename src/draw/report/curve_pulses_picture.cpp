#include "passo/report/curve_pulses_picture.hpp"

#include <algorithm>
#include <bit>

#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"
#include "step_view.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

using sheet::margin;
const Colour chords_colour{0.45, 0.30, 0.62};
const Colour chart_colour = step_look::one_axis;

Place place_of(const StepPlace& place) {
  return {place[0].count, place[1].count, place[2].count};
}

double coordinate(const Vector3& place, const StepScale& scale, std::size_t axis) {
  const double mm = axis == 0 ? place.x : axis == 1 ? place.y : place.z;
  return mm * scale.steps_per_mm[axis];
}

std::vector<Shown> shown_of(const CurvePulsesScene& scene) {
  std::vector<Shown> all = {{.place = place_of(scene.chords.front())}};
  for (const CurvePulse& pulse : scene.pulses) {
    const int axes = std::popcount(pulse.pulse.steps);
    if (axes == 0) {
      all.back().waited = true;
    } else {
      all.push_back({.place = place_of(pulse.place), .axes = axes});
    }
  }
  return all;
}

void draw_view(Canvas& canvas, const CurvePulsesScene& scene, const std::vector<Shown>& shown, std::size_t up,
               const Area& area) {
  std::vector<Spot> curve;
  for (const Vector3& place : scene.curve) {
    curve.push_back({coordinate(place, scene.scale, 0), coordinate(place, scene.scale, up)});
  }
  const StepView view(shown, curve, 0, up, area);
  draw_step_grid(canvas, view);
  draw_pulses(canvas, view, shown);
  const auto stroke = [&](const Pen& pen) { canvas.stroke(pen); };
  canvas.move_to(view.spot(place_of(scene.chords.front())));
  for (const StepPlace& end : scene.chords) canvas.line_to(view.spot(place_of(end)));
  stroke({.colour = chords_colour, .width = 1.4});
  canvas.move_to(view.spot(curve.front().x, curve.front().y));
  for (const Spot& spot : curve) canvas.line_to(view.spot(spot.x, spot.y));
  stroke({.colour = step_look::ideal_colour, .width = 1.4});
  // A ring, so that the pulse on a chord's end can be seen.
  const double radius = std::clamp(view.scale() * 0.32, 2.5, 8.0);
  for (const StepPlace& end : scene.chords) {
    const Spot spot = view.spot(place_of(end));
    const Area ring{spot.x - radius, spot.y - radius, 2 * radius, 2 * radius};
    canvas.frame(ring, {.colour = chords_colour, .width = 1.3});
  }
}

void draw_deviations(Canvas& canvas, const CurvePulsesScene& scene, const Area& area) {
  constexpr double um = 1000;
  std::vector<Spot> curve = {{0, 0}};
  for (const CurvePulse& pulse : scene.pulses) {
    curve.push_back({static_cast<double>(curve.size()), pulse.deviation.value() * um});
  }
  const double most = std::max(scene.measures.largest_deviation.value() * um, 1e-3);
  Chart chart(canvas, area, {.title = "Pulse", .end = static_cast<double>(scene.pulses.size())},
              {.title = "From the curve, \u00B5m", .end = axis_end(most * 1.05)});
  chart.draw_grid();
  chart.polyline(curve, {.colour = chart_colour, .width = 1.3});
  chart.draw_frame();
}

std::string figures(const CurvePulsesScene& scene) {
  const CurveMeasures& found = scene.measures;
  std::string text =
      fmt::format("{}   \u00B7   {}: {}", counted(found.chords, "chord"), scene.method, counted(found.pulses, "pulse"));
  if (found.together != 0) text += fmt::format(", {} of several axes", found.together);
  if (found.idle != 0) text += fmt::format(", {} of none", found.idle);
  const auto& steps = scene.scale.steps_per_mm;
  const auto both = [&](Mm deviation) {
    const std::string um = fmt::format("{:.4g} \u00B5m", deviation.value() * 1000);
    if (steps[0] != steps[1] || steps[1] != steps[2]) return um;
    return fmt::format("{:.2f} step ({})", deviation.value() * steps[0], um);
  };
  return text + "   \u00B7   off the curve by " + both(found.largest_deviation) + " at most, " +
         both(found.mean_deviation) + " on average";
}

}  // namespace

Status<OutputError> draw_curve_pulses(const CurvePulsesScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  canvas.fill({0, 0, width, height}, sheet::paper);
  canvas.text({margin, 40}, options.program, step_look::title_font);
  canvas.text({margin, 70}, options.machine, step_look::caption_font);
  canvas.text({margin, 92}, figures(scene), step_look::caption_font);
  std::vector<StepKey> keys = step_keys();
  keys[0].text = "curve";
  keys.push_back({"chords, ends rounded to steps", chords_colour, true});
  draw_step_keys(canvas, keys, margin, 118);

  const std::vector<Shown> shown = shown_of(scene);
  const bool flat = std::ranges::all_of(shown, [&](const Shown& one) { return one.place[2] == shown[0].place[2]; });
  constexpr double upper = 150;
  const double views = height - upper - 250;
  const double wide = width - 2 * margin - 40;
  draw_view(canvas, scene, shown, 1, {margin + 20, upper, flat ? wide : wide / 2 - 30, views});
  if (!flat) draw_view(canvas, scene, shown, 2, {margin + 20 + wide / 2 + 30, upper, wide / 2 - 30, views});
  draw_deviations(canvas, scene, {margin + 46, height - 190, width - 2 * margin - 46, 130});
  return canvas.finish();
}

}  // namespace passo
