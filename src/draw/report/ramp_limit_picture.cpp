#include "passo/report/ramp_limit_picture.hpp"

#include <algorithm>
#include <array>

#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

using namespace sheet;
// A colour for each size of the table. Half the acceleration in twice the table is the same curve: dashes show both.
const std::array<Pen, 3> size_pens = {Pen{.colour = {0.10, 0.33, 0.60}, .width = 2.2},
                                      Pen{.colour = {0.80, 0.40, 0.05}, .width = 2.2, .opacity = 1, .dashes = {10, 7}},
                                      Pen{.colour = {0.05, 0.42, 0.25}, .width = 2.2, .opacity = 1, .dashes = {3, 5}}};
const Pen wanted_pen{.colour = {0.55, 0.20, 0.45}, .width = 1.2};

// Calls value(steps a revolution) all along the axis and joins the values.
template <class Value>
std::vector<Spot> curve_of(const RampLimitScene& scene, const Value& value) {
  constexpr int pieces = 200;
  std::vector<Spot> spots;
  const double span = scene.most_steps_per_turn - scene.least_steps_per_turn;
  for (int i = 0; i <= pieces; ++i) {
    const auto steps = static_cast<std::int32_t>(scene.least_steps_per_turn + span * i / pieces + 0.5);
    spots.push_back({static_cast<double>(steps), value(steps)});
  }
  return spots;
}

Chart::Axis steps_axis(const RampLimitScene& scene) {
  return {.title = "Steps per revolution", .end = axis_end(scene.most_steps_per_turn)};
}

void draw_least_accelerations(Canvas& canvas, const Area& area, const RampLimitScene& scene) {
  const auto least = [&](std::int32_t size, std::int32_t steps) {
    return least_acceleration(*scene.rate, size, steps).value;
  };
  const std::int32_t smallest = *std::ranges::min_element(scene.table_sizes);
  Chart chart(canvas, area, steps_axis(scene),
              {.title = fmt::format("Least acceleration for {:g} steps/s, rad/s\u00B2", scene.rate->value()),
               .end = axis_end(least(smallest, scene.least_steps_per_turn))});
  chart.draw_grid();
  for (std::size_t i = 0; i < scene.table_sizes.size(); ++i) {
    const std::int32_t size = scene.table_sizes[i];
    chart.polyline(curve_of(scene, [&](std::int32_t steps) { return least(size, steps); }), size_pens[i]);
  }
  chart.draw_frame();
}

void draw_reached_rates(Canvas& canvas, const Area& area, const RampLimitScene& scene) {
  const auto reached = [](RadiansPerSecond2 acceleration, std::int32_t size, std::int32_t steps) {
    return reached_rate(acceleration, size, steps).value();
  };
  const std::int32_t largest = *std::ranges::max_element(scene.table_sizes);
  const double most = reached(scene.accelerations.back(), largest, scene.most_steps_per_turn);
  Chart chart(canvas, area, steps_axis(scene),
              {.title = "Rate at the end of the table, steps/s", .end = axis_end(most * 1.02)});
  chart.draw_grid();
  for (std::size_t i = 0; i < scene.table_sizes.size(); ++i) {
    for (const RadiansPerSecond2 acceleration : scene.accelerations) {
      const std::vector<Spot> curve =
          curve_of(scene, [&](std::int32_t steps) { return reached(acceleration, scene.table_sizes[i], steps); });
      chart.polyline(curve, size_pens[i]);
      // Of one table the numbers stand at the ends, of the next one a little before, above the curve.
      const Font font{.size = label.size, .colour = size_pens[i].colour};
      const Spot& at = curve[curve.size() - 1 - i * curve.size() / 8];
      const Spot spot = chart.at(at.x, at.y);
      const std::string number = fmt::format("{:g}", acceleration.value);
      canvas.text(i == 0 ? Spot{spot.x + 8, spot.y} : Spot{spot.x, spot.y - 11}, number, font);
    }
  }
  if (scene.rate) chart.polyline({{0, scene.rate->value()}, {steps_axis(scene).end, scene.rate->value()}}, wanted_pen);
  chart.draw_frame();
}

void draw_legend(Canvas& canvas, const RampLimitScene& scene, Spot place) {
  Legend legend(canvas, place);
  for (std::size_t i = 0; i < scene.table_sizes.size(); ++i) {
    legend.line(size_pens[i],
                "table of " + counted(static_cast<std::uint32_t>(scene.table_sizes[i]), "entry", "entries"));
  }
  if (scene.rate) legend.line(wanted_pen, fmt::format("target: {:g} steps/s", scene.rate->value()));
  legend.words("labels of the curves: acceleration, rad/s\u00B2");
}

}  // namespace

Status<OutputError> draw_ramp_limits(const RampLimitScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  begin_sheet(canvas, options);
  constexpr double left = margin + 52;
  constexpr double upper = 128;
  const double tall = height - upper - 130;
  const double whole = width - left - margin;
  if (scene.rate) {
    const double half = (whole - 110) / 2;
    draw_least_accelerations(canvas, {left, upper, half - 40, tall}, scene);
    draw_reached_rates(canvas, {left + half + 80, upper, half + 20, tall}, scene);
  } else {
    draw_reached_rates(canvas, {left, upper, whole, tall}, scene);
  }
  draw_legend(canvas, scene, {left, height - 42});
  return canvas.finish();
}

}  // namespace passo
