// PathBuilder: feeds, and what waits for the spindle or follows it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "path_sentences.hpp"
#include <fmt/format.h>

#include "passo/geometry/euclid.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/run_up.hpp"

namespace passo {
namespace {

// After an error a move still needs some speed, so that the checking pass can go on.
constexpr MmPerSecond speed_after_error{1};

constexpr double rounding_of_feed = 1e-9;

// What may be had, rounded down, so that it is accepted.
double rounded_down(double value, int decimals) {
  const double unit = std::pow(10.0, decimals);
  return std::floor(value * unit) / unit;
}

// A smaller radius (mm) counts as this one. At the rotation axis itself the surface stands still at any speed.
constexpr double least_radius = 0.01;

// Radii between two steps of this share count as equal, so that lines at nearly the same depth are still alike.
constexpr double radius_step = 0.002;

double rounded_radius(double radius) {
  return std::exp(std::round(std::log(std::max(radius, least_radius)) / radius_step) * radius_step);
}

bool turns_only_rotary_axes(const Curve& curve) {
  if (curve.shape() != Curve::Shape::line) return false;
  for (const Axis axis : all_axes) {
    if (!is_rotary(axis) && curve.moves(axis)) return false;
  }
  return true;
}

bool has_other_speed(const OutputState& one, const OutputState& other) {
  return one.spindle != other.spindle || one.revolutions_per_minute != other.revolutions_per_minute;
}

}  // namespace

// What is left of an earlier change of speed is added.
Seconds PathBuilder::run_up_after(const OutputState& before) const {
  const bool is_off = outputs().spindle == SpindleDirection::off;
  return (is_off ? Seconds(0) : speed_wait_.run_up_left) + run_up_time(before, outputs(), options_.spindle_run_up);
}

// A dwell of the program counts as part of the wait.
bool PathBuilder::must_await_run_up(const PathItem& item) {
  if (speed_wait_.run_up_left == Seconds(0)) return false;
  const auto* action = std::get_if<Action>(&item);
  if (action != nullptr && action->kind == Action::Kind::dwell) {
    speed_wait_.run_up_left = std::max(speed_wait_.run_up_left - action->dwell, Seconds(0));
  }
  return action == nullptr || action->kind == Action::Kind::probe_begin;
}

bool PathBuilder::must_await_speed(const PathItem& item) {
  const auto* action = std::get_if<Action>(&item);
  const bool moves = action == nullptr || action->kind == Action::Kind::probe_begin;
  return moves && std::exchange(speed_wait_.is_new, false);
}

// A thread directly after another thread stays in step, and need not wait for the index.
bool PathBuilder::must_await_index(const PathItem& item) {
  const auto* segment = std::get_if<Segment>(&item);
  if (followed_tap_ == TapStep::back && segment == nullptr) return false;
  const bool was = in_step_;
  in_step_ = segment != nullptr && segment->lock == SpindleLock::place;
  return in_step_ && !was;
}

// The surfaces that count on the way to a point. A rapid has no feed, and a thread its pitch along the linear axes.
SurfaceScale PathBuilder::surface_to(const Point& machine_end, bool rapid) const {
  SurfaceScale scale;
  if (!has_surfaces_ || rapid || synchronised_pitch_) return scale;
  for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
    const std::optional<Mm>& given = options_.surface_radius[axis];
    if (!given) continue;
    double radius = given->value();
    if (radius == 0) {
      const double from = frame_.work_from_machine(position_)[Axis::z];
      const double to = frame_.work_from_machine(machine_end)[Axis::z];
      radius = rounded_radius((std::abs(from) + std::abs(to)) / 2);
    }
    scale[axis] = radius * std::numbers::pi / 180;
  }
  return scale;
}

MmPerSecond PathBuilder::feed_along(const Curve& curve, const SurfaceScale& surface) {
  if (synchronised_pitch_) return feed_with_spindle(synchronised_pitch_->value());
  const bool only_turns = turns_only_rotary_axes(curve);
  const double on_surface = has_surfaces_ ? std::sqrt(surface.square_of(curve.end() - curve.start())) : 0;
  const auto* const timed = std::get_if<operation::FeedPerSecond>(&feed_rate_.feed);
  if (timed != nullptr && timed->by_time && on_surface > 0) {
    // The duration is that without the surface. The length is not.
    const double length = curve.length().value();
    const double counted = only_turns ? counted_length(curve.end() - curve.start())
                                      : std::sqrt(std::max(length * length - on_surface * on_surface, 0.0));
    const double rate = only_turns ? timed->rotary : timed->linear.value();
    if (rate > 0 && counted > 0) return MmPerSecond(rate * length / counted);
  }
  const bool is_rotary = only_turns && on_surface == 0;
  const double rate = std::visit(
      [is_rotary](const auto& feed) { return is_rotary ? feed.rotary : feed.linear.value(); }, feed_rate_.feed);
  if (std::holds_alternative<operation::FeedPerRevolution>(feed_rate_.feed)) return feed_with_spindle(rate);
  if (rate > 0) return MmPerSecond(rate);
  report(Severity::error, "path.no-feed", path_says::no_feed, path_says::feed_above_zero);
  return speed_after_error;
}

MmPerSecond PathBuilder::feed_with_spindle(double mm_per_revolution) {
  const double rate = mm_per_revolution * outputs().revolutions_per_minute / seconds_per_minute;
  if (rate > 0) return MmPerSecond(rate);
  report(Severity::error, "path.spindle-off",
         mm_per_revolution > 0 ? "the feed follows the spindle, but the spindle is stopped"
                               : "the feed follows the spindle, but the feed per revolution is 0",
         "S above 0 with M3 or M4, and a pitch (K) or feed (F) above 0, before the move");
  return speed_after_error;
}

void PathBuilder::set_spindle_speed(double revolutions_per_minute) {
  const double limit = options_.spindle_limit;
  commanded_.revolutions_per_minute = limit > 0 ? std::min(revolutions_per_minute, limit) : revolutions_per_minute;
  if (!(limit > 0 && revolutions_per_minute > limit) || revolutions_per_minute == refused_.spindle_speed) return;
  refused_.spindle_speed = revolutions_per_minute;
  const std::string most = fmt::format("{:.0f}", limit);
  report(Severity::warning, "path.spindle-too-fast",
         path_says::spindle_too_fast.with({{"asked", fmt::format("{:.0f}", revolutions_per_minute)}, {"most", most}}),
         path_says::speed_up_to.with({{"most", most}}));
}

// The power of the laser for an S.
bool PathBuilder::set_power(double s) {
  const LaserOptions& laser = *options_.outputs.laser;
  in_motion_.set_power(s > 0 ? std::clamp(s / laser.maximum_s, laser.minimum, 1.0) : 0);
  if (s <= laser.maximum_s || s == refused_.spindle_speed) return false;
  refused_.spindle_speed = s;
  report(Severity::warning, "path.laser-too-strong", fmt::format("S{:g} is more than the laser's full power", s),
         fmt::format("S up to {:g}, maximum_s of [laser] in the machine file", laser.maximum_s));
  return false;
}

bool PathBuilder::set_digital(const operation::SetDigitalOutput& set) {
  const std::uint8_t bit = options_.outputs.bit_of(set.output);
  if (bit == 0) return lacks(TorqueShortage::outputs), false;
  in_motion_.set_digital(bit, set.on, set.with_motion);
  outputs_source_ = operation_.source;
  return false;
}

// With a laser, the analog output 0 is its power, in the unit of S.
bool PathBuilder::set_analog(const operation::SetAnalogOutput& set) {
  if (!options_.outputs.laser || set.output != 0) return lacks(TorqueShortage::outputs), false;
  return set_power(set.value);
}

// The planner would slow down a feed that is too fast for an axis, and a thread would then get another pitch.
void PathBuilder::check_thread(const Curve& curve, MmPerSecond speed) {
  const double rpm = outputs().revolutions_per_minute;
  if (rpm == 0 || speed == refused_.feed) return;
  const Point slopes = curve.steepest();
  Axis slowest = Axis::x;
  double times = 1;  // what is asked of the slowest axis, as a multiple of what it can do
  for (const Axis axis : all_axes) {
    const double limit = options_.velocity[axis].value();
    if (!(limit > 0) || slopes[axis] * speed.value() <= limit * times * (1 + rounding_of_feed)) continue;
    times = slopes[axis] * speed.value() / limit;
    slowest = axis;
  }
  if (times == 1) return;
  refused_.feed = speed;
  const bool inches = units_ == LengthUnits::inch;
  const double length = inches ? mm_per_inch : 1;
  const double pitch = speed.value() * seconds_per_minute / rpm / length;
  const char* const unit = inches ? "inches" : "mm";
  const int decimals = inches ? 4 : 3;
  const double limit = options_.velocity[slowest].value();
  report(Severity::error, "path.thread-too-fast",
         fmt::format("at {:g} rpm and {:.{}f} {}/rev, {} would have to move at {:.1f} {}/s, above its limit of {:g}",
                     rpm, pitch, decimals, unit, letter_of(slowest), limit * times,
                     is_rotary(slowest) ? "degrees" : "mm", limit),
         fmt::format("S up to {:g}, or up to {:.{}f} {}/rev", rounded_down(rpm / times, rpm / times < 10 ? 2 : 0),
                     rounded_down(pitch / times, decimals), decimals, unit));
}

// A change of the digital outputs needs a stop only where no motion follows that switches them.
bool PathBuilder::must_switch(bool has_item, const PathItem& item) const {
  if (outputs() != handed_on_) return true;
  return in_motion_.is_news() && !(has_item && std::holds_alternative<Segment>(item));
}

// For a spindle whose speed is awaited: what has changed since the last item.
void PathBuilder::record_new_speed() {
  const bool is_off = outputs().spindle == SpindleDirection::off;
  speed_wait_.is_new = !is_off && (speed_wait_.is_new || has_other_speed(handed_on_, outputs()));
  // A tapping cycle (G84) permits no overrides.
  const bool turns_back = !is_off && outputs().spindle == reversed(handed_on_.spindle);
  if (!turns_back || heeds().feed_override) return;
  report(Severity::error, "path.tap-on-bus", path_says::tap_on_bus, path_says::not_on_bus);
}

}  // namespace passo
