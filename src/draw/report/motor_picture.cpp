#include "passo/report/motor_picture.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "axis_ticks.hpp"
#include "canvas.hpp"
#include "chart.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// Everyone can tell blue and orange apart, even in grey.
const Pen pull_out_pen{.colour = {0.10, 0.33, 0.60}, .width = 2.6};
const Pen pull_in_pen{.colour = {0.80, 0.40, 0.05}, .width = 2.6};
const Pen friction_pen{.colour = {0.45, 0.20, 0.45}, .width = 1.8, .opacity = 1, .dashes = {9, 6}};
const Pen acceleration_pen{.colour = {0.10, 0.45, 0.30}, .width = 2.6};
const Pen guide{.colour = {0.45, 0.47, 0.50}, .width = 1, .opacity = 1, .dashes = {2, 4}};
const Colour start_shade{0.99, 0.87, 0.70};
const Colour ramp_shade{0.86, 0.92, 0.98};
const Colour acceleration_shade{0.87, 0.95, 0.90};
using namespace sheet;

// All values as functions of the rate. The rate is along x in both charts.
struct Functions {
  explicit Functions(const MotorScene& motor) : scene(motor) {}
  RadiansPerSecond speed(double rate) const { return scene.curve.speed_at(Hertz(rate)); }
  double pull_out(double rate) const { return scene.curve.pull_out(speed(rate)).value; }
  double pull_in(double rate) const { return scene.curve.pull_in(speed(rate), scene.load.inertia).value; }
  double friction(double rate) const { return scene.load.friction_at(speed(rate)).value; }
  bool has_friction() const { return scene.load.friction.value > 0 || scene.load.friction_per_speed.value > 0; }
  double acceleration(double rate) const {
    return scene.curve.available_acceleration(speed(rate), scene.load, scene.margin).value;
  }
  double starting_rate() const { return scene.curve.rate_at(scene.curve.maximum_starting_speed(scene.load)).value(); }
  // The fastest rate with the load. Empty if the model has no fastest rate.
  std::optional<double> fastest_rate() const {
    const auto speed = scene.curve.fastest_speed(scene.load);
    return speed ? std::optional(scene.curve.rate_at(*speed).value()) : std::nullopt;
  }
  // The rate at which the curve of torque ends. If the curve was made of points, it ends there with a step down.
  double end_of_pull_out() const {
    const auto speed = scene.curve.fastest_speed({});
    return speed ? scene.curve.rate_at(*speed).value() : HUGE_VAL;
  }
  double end_of_pull_in() const {
    return scene.curve.rate_at(scene.curve.maximum_starting_speed({.inertia = scene.load.inertia})).value();
  }

  const MotorScene& scene;
};

// Draws words on a backing, so that lines pass behind the words. The words stand to the right of `spot` and above it,
// or to the left and below if there is no room on the right. A falling curve through `spot` passes on the other sides.
void draw_note(Canvas& canvas, const Chart& chart, Spot spot, const std::string& text) {
  const Area& frame = chart.area();
  const double width = canvas.text_width(text, caption);
  const bool left = spot.x + 12 + width + 8 > frame.right();
  const Spot begin{left ? spot.x - 14 - width : spot.x + 12,
                   std::clamp(left ? spot.y + 20 : spot.y - 20, frame.y + 16, frame.bottom() - 16)};
  const Area backing{begin.x - 5, begin.y - 10, width + 10, 20};
  canvas.fill({{backing.x, backing.y},
               {backing.right(), backing.y},
               {backing.right(), backing.bottom()},
               {backing.x, backing.bottom()}},
              paper, 0.85);
  canvas.text(begin, text, caption);
}

void draw_dot(Canvas& canvas, Spot spot, const Colour& colour) {
  canvas.disc(spot, 5.5, paper);
  canvas.disc(spot, 4, colour);
}

std::string rate_text(double rate) {
  return fmt::format("{:.0f} steps/s", rate);
}

void draw_torque(Chart& chart, const Functions& motor) {
  const auto pull_out = [&](double rate) { return motor.pull_out(rate); };
  const auto pull_in = [&](double rate) { return motor.pull_in(rate); };
  const auto zero = [](double) { return 0.0; };
  chart.draw_grid(false);
  chart.draw_upper_scale("rev/min", motor.scene.curve.rotor().steps_per_revolution / seconds_per_minute);
  chart.fill_between(zero, pull_out, motor.end_of_pull_out(), ramp_shade, 0.75);
  chart.fill_between(zero, pull_in, motor.end_of_pull_in(), start_shade, 0.9);
  chart.curve(pull_in, pull_in_pen, motor.end_of_pull_in());
  chart.curve(pull_out, pull_out_pen, motor.end_of_pull_out());
  if (motor.has_friction()) chart.curve([&](double rate) { return motor.friction(rate); }, friction_pen);
  chart.draw_frame();
}

// Marks the two important rates in both charts.
void draw_rates(Canvas& canvas, const Chart& torque, const Chart& acceleration, const Functions& motor, double end) {
  const double starting = motor.starting_rate();
  const std::optional<double> fastest = motor.fastest_rate();
  const auto draw = [&](double rate, const Pen& pen, const std::string& words) {
    const Spot upper = torque.at(rate, motor.friction(rate));
    canvas.line(upper, torque.at(rate, 0), guide);
    canvas.line({upper.x, acceleration.area().y}, acceleration.at(rate, 0), guide);
    draw_dot(canvas, upper, pen.colour);
    draw_note(canvas, torque, upper, words + rate_text(rate));
  };
  if (starting > 0 && starting <= end) draw(starting, pull_in_pen, "starts and stops without a ramp up to ");
  if (fastest && *fastest > 0 && *fastest <= end) draw(*fastest, pull_out_pen, "runs up to ");
}

void draw_acceleration(Chart& chart, const Functions& motor) {
  const auto acceleration = [&](double rate) { return motor.acceleration(rate); };
  const double end = std::min(motor.end_of_pull_out(), motor.fastest_rate().value_or(HUGE_VAL));
  chart.draw_grid();
  chart.fill_between([](double) { return 0.0; }, acceleration, end, acceleration_shade);
  chart.curve(acceleration, acceleration_pen, end);
  chart.draw_frame();
}

void draw_legend(Canvas& canvas, const Functions& motor, Spot place) {
  const bool has_load = motor.scene.load.inertia.value > 0;
  Legend legend(canvas, place);
  legend.line(pull_out_pen, "Pull-out");
  legend.line(pull_in_pen, has_load ? "Pull-in with the load's inertia" : "Pull-in, rotor's inertia only");
  if (motor.has_friction()) legend.line(friction_pen, "Friction");
  legend.patch(start_shade, "starts and stops without a ramp");
  legend.patch(ramp_shade, "runs, but needs a ramp");
}

}  // namespace

Status<OutputError> draw_motor_picture(const MotorScene& scene, const PictureOptions& options, OutputFile& file) {
  Canvas canvas(options, file);
  const double width = options.width;
  const double height = options.height;
  begin_sheet(canvas, options);

  const Functions motor(scene);
  const double rates = axis_end(scene.end.value());
  const double torques = axis_end(1.08 * std::max(motor.pull_out(0), motor.friction(0)));
  const double accelerations = axis_end(1.08 * motor.acceleration(0));
  constexpr double left = margin + 52;
  constexpr double upper = 148;
  const double space = height - upper - 130;  // height for both charts and the gap between them
  const Area upper_area{left, upper, width - left - margin, 0.64 * space};
  const Area lower_area{left, upper_area.bottom() + 48, upper_area.width, space - upper_area.height - 48};
  Chart torque(canvas, upper_area, {.title = "", .end = rates}, {.title = "Torque, N\u00B7m", .end = torques});
  Chart acceleration(canvas, lower_area, {.title = "Rate, full steps/s", .end = rates},
                     {.title = "Available acceleration, rad/s\u00B2", .end = accelerations});
  draw_torque(torque, motor);
  draw_acceleration(acceleration, motor);
  draw_rates(canvas, torque, acceleration, motor, rates);
  draw_legend(canvas, motor, {left, height - 46});
  return canvas.finish();
}

}  // namespace passo
