#include <algorithm>
#include <array>
#include <cmath>

#include "canvas.hpp"
#include "chart.hpp"
#include "phase_currents.hpp"
#include "sheet.hpp"
#include "step_view.hpp"
#include <fmt/format.h>

#include "passo/report/winding_record.hpp"
#include "passo/study/measure.hpp"

namespace passo {
namespace {

const Colour on_colour{0.93, 0.55, 0.10};
const Colour off_colour{0.93, 0.94, 0.95};
const Pen phase_a{.colour = {0.10, 0.33, 0.60}, .width = 1.8};
const Pen phase_b{.colour = {0.80, 0.40, 0.05}, .width = 1.8};
const Pen rotor_pen{.colour = {0.05, 0.42, 0.25}, .width = 1.8};
using namespace sheet;

// A motor stands at `place` from `from` to `to`, in units of the time axis.
struct Stand {
  double from = 0;
  double to = 0;
  std::int64_t place = 0;
};

// A little beyond the end, so that the last step is seen, and its currents.
double shown_end(const WindingScene& scene) {
  constexpr double constants_of_rise = 4;
  const auto& stage = scene.motors.stage;
  const double rise = stage ? constants_of_rise * stage->circuit.time_constant().value() : 0;
  return std::max({scene.end.value() * 1.03, scene.end.value() + rise, 1e-9});
}

std::vector<Stand> stands_of(const WindingScene& scene, std::size_t motor, double unit) {
  std::vector<Stand> stands = {{}};
  Place place(scene.motors.count, 0);
  for (const TimedPulse& timed : scene.pulses) {
    apply(timed.pulse, place);
    if ((timed.pulse.steps >> motor & 1) == 0) continue;
    stands.back().to = timed.time.value() * unit;
    stands.push_back({.from = stands.back().to, .to = 0, .place = place[motor]});
  }
  stands.back().to = shown_end(scene) * unit;
  return stands;
}

// Four lanes: filled where the output carries current.
void draw_outputs(Canvas& canvas, const Area& area, const WindingScene& scene, const std::vector<Stand>& stands,
                  double time_end) {
  const double lane = area.height / winding_outputs;
  for (unsigned f = 0; f < winding_outputs; ++f) {
    const Area row{area.x, area.y + f * lane + 4, area.width, lane - 8};
    canvas.fill(row, off_colour);
    // Stands that follow each other are one bar: seams would look like steps.
    for (std::size_t i = 0; i < stands.size();) {
      std::size_t next = i;
      while (next < stands.size() && scene.motors.excitation.at(stands[next].place).on(f)) ++next;
      if (next > i) {
        const double from = stands[i].from / time_end;
        const double to = stands[next - 1].to / time_end;
        canvas.fill({row.x + from * row.width, row.y, (to - from) * row.width, row.height}, on_colour);
      }
      i = std::max(next, i + 1);
    }
    canvas.frame(row, edge);
    canvas.text({row.x - 9, row.y + row.height / 2}, fmt::format("F{}", f + 1), label, Align::right);
  }
}

template <class Value>
std::vector<Spot> stair(const std::vector<Stand>& stands, const Value& value) {
  std::vector<Spot> spots;
  for (const Stand& stand : stands) {
    spots.push_back({stand.from, value(stand.place)});
    spots.push_back({stand.to, value(stand.place)});
  }
  return spots;
}

// The currents of one motor's phases over time.
struct PhaseLines {
  std::vector<Spot> a = {};
  std::vector<Spot> b = {};
};

std::vector<PhaseLines> phase_lines(const WindingScene& scene, double unit) {
  std::vector<PhaseLines> lines(scene.motors.count);
  PhaseCurrents currents(scene.motors);
  Place place(scene.motors.count, 0);
  // Between two pulses, points that would be less than about a pixel from the last one are left out.
  const auto show = [&](double least) {
    for (std::size_t motor = 0; motor < scene.motors.count; ++motor) {
      const auto [a, b] = currents.of(motor);
      const double now = currents.now().value() * unit;
      auto& [of_a, of_b] = lines[motor];
      if (of_a.empty() || std::abs(a - of_a.back().y) >= least) of_a.push_back({now, a});
      if (of_b.empty() || std::abs(b - of_b.back().y) >= least) of_b.push_back({now, b});
    }
  };
  constexpr double pixel = 0.01;
  const auto show_between = [&] { show(pixel); };
  show(0);
  for (const TimedPulse& timed : scene.pulses) {
    currents.play(timed.time, show_between);
    show(0);
    apply(timed.pulse, place);
    for (std::size_t motor = 0; motor < scene.motors.count; ++motor) currents.move_to(motor, place[motor]);
    show(0);
  }
  currents.play(Seconds(shown_end(scene)), show_between);
  show(0);
  return lines;
}

void draw_phases(Canvas& canvas, const Area& area, const PhaseLines& lines, double time_end) {
  Chart chart(canvas, area, {.title = "", .end = time_end},
              {.title = "Current, fraction of rated", .end = 1.2, .begin = -1.2});
  chart.draw_grid(false);
  chart.polyline(lines.a, phase_a);
  chart.polyline(lines.b, phase_b);
  chart.draw_frame();
  const double y = area.y - 12;
  canvas.line({area.right() - 290, y}, {area.right() - 266, y}, phase_a);
  canvas.text({area.right() - 260, y}, "phase A (F1, F3)", label);
  canvas.line({area.right() - 136, y}, {area.right() - 112, y}, phase_b);
  canvas.text({area.right() - 106, y}, "phase B (F2, F4)", label);
}

void draw_rotor(Canvas& canvas, const Area& area, const WindingScene& scene, const std::vector<Stand>& stands,
                double time_end, const std::string& time_title) {
  const auto degrees = [&](std::int64_t place) {
    return scene.motors.excitation.rotor_degrees(place, scene.motors.full_steps_per_turn);
  };
  double low = 0;
  double high = 0;
  for (const Stand& stand : stands) {
    low = std::min(low, degrees(stand.place));
    high = std::max(high, degrees(stand.place));
  }
  if (low == high) high = 1;
  Chart chart(canvas, area, {.title = time_title, .end = time_end},
              {.title = "Rotor, degrees",
               .end = high > 0 ? axis_end(high * 1.02) : 0,
               .begin = low < 0 ? -axis_end(-low * 1.02) : 0});
  chart.draw_grid();
  chart.polyline(stair(stands, degrees), rotor_pen);
  chart.draw_frame();
}

}  // namespace

Status<OutputError> draw_windings(const WindingScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  begin_sheet(canvas, options);
  const bool in_ms = scene.end < Seconds(2);
  const double unit = in_ms ? 1000 : 1;
  const double time_end = shown_end(scene) * unit;
  const double column = (width - margin) / static_cast<double>(scene.motors.count);
  const double space = height - 128 - 60;
  const std::vector<PhaseLines> lines = phase_lines(scene, unit);
  for (std::size_t motor = 0; motor < scene.motors.count; ++motor) {
    const double left = margin + static_cast<double>(motor) * column + 44;
    const double wide = column - 44 - margin;
    canvas.text({left, 106}, "Motor " + axis_name(motor), step_look::heading_font);
    const std::vector<Stand> stands = stands_of(scene, motor, unit);
    draw_outputs(canvas, {left, 124, wide, space * 0.26}, scene, stands, time_end);
    draw_phases(canvas, {left, 124 + space * 0.33, wide, space * 0.27}, lines[motor], time_end);
    draw_rotor(canvas, {left, 124 + space * 0.66, wide, space * 0.34}, scene, stands, time_end,
               in_ms ? "Time, ms" : "Time, s");
  }
  return canvas.finish();
}

}  // namespace passo
