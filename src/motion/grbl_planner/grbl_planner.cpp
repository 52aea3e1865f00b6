#include "passo/grbl_planner/grbl_planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

constexpr double straight = 0.999999;  // cosine of an angle that counts as none, or as a reversal
constexpr double same_angle = 5e-7;    // radians; a smaller turn is a full circle
constexpr double most_chords = 1e6;    // of one arc
constexpr double slowest = 1.0 / 60;   // mm/s; Grbl raises lower feeds to it

double dot(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < axis_count; ++i) sum += a.values[i] * b.values[i];
  return sum;
}

double square(double value) {
  return value * value;
}

}  // namespace

Point GrblLimits::measured(Point way) const {
  if (!core_xy) return way;
  const double x = way[Axis::x];
  const double y = way[Axis::y];
  way[Axis::x] = x + y;
  way[Axis::y] = x - y;
  return way;
}

MmPerSecond GrblLimits::measured_feed(const Point& way, MmPerSecond feed) const {
  if (!core_xy || !feeds_tool) return feed;
  const Point motors = measured(way);
  const double length = std::sqrt(dot(way, way));
  // A full circle has no way from end to end.
  return feed * (length > 0 ? std::sqrt(dot(motors, motors)) / length : std::numbers::sqrt2);
}

GrblPlanner::GrblPlanner(const GrblLimits& limits, const Point& start) : limits_(limits), at_(start) {
  assert(limits.blocks >= 1);
  for (const Axis axis : all_axes) {
    if (limits_.steps_per_mm[axis] <= 0) continue;
    fastest_[axis] = limits_.velocity[axis].value();
    strongest_[axis] = limits_.acceleration[axis].value();
  }
  last_step_ = rounded(start);
}

Point GrblPlanner::rounded(const Point& place) const {
  Point steps;
  for (const Axis axis : all_axes) {
    const double per_unit = limits_.steps_per_mm[axis];
    if (per_unit > 0) steps[axis] = std::round(place[axis] * per_unit) / per_unit;
  }
  return steps;
}

double GrblPlanner::limit_along(const Point& direction, const PerAxis<double>& limits) const {
  double limit = std::numeric_limits<double>::max();
  for (const Axis axis : all_axes) {
    if (direction[axis] != 0) limit = std::min(limit, limits[axis] / std::abs(direction[axis]));
  }
  return limit;
}

// The square of the highest speed at the junction with the last block.
double GrblPlanner::junction2(const Point& direction) const {
  const double cosine = -dot(direction_, direction);
  if (cosine > straight) return 0;
  if (cosine < -straight) return std::numeric_limits<double>::max();
  Point change = direction - direction_;
  change = change * (1 / std::sqrt(dot(change, change)));
  const double sine = std::sqrt((1 - cosine) / 2);
  return limit_along(change, strongest_) * limits_.junction_deviation.value() * sine / (1 - sine);
}

Seconds GrblPlanner::add_line(const Point& end, MmPerSecond feed, std::uint32_t source, Seconds when) {
  at_ = end;
  const Point step = rounded(end);
  const Point moved = step - last_step_;
  const Point way = limits_.measured(moved);
  const double length = std::sqrt(dot(way, way));
  if (length <= 0) return std::max(when, Seconds(0));
  if (blocks_.size() == limits_.blocks) end_first(profile());
  run_until(when.value());
  const Point direction = way * (1 / length);
  Block block{.motion = {.source = source,
                         .rapid = std::isinf(feed.value()),
                         .feed = limits_.measured_feed(moved, feed),
                         .start = last_step_,
                         .end = step,
                         .length = Mm(length),
                         .acceleration = MmPerSecond2(limit_along(direction, strongest_)),
                         .scale = limits_.core_xy ? std::sqrt(dot(moved, moved)) / length : 1}};
  const double fastest = limit_along(direction, fastest_);
  const double wanted =
      block.motion.rapid ? fastest * limits_.rapid_factor : block.motion.feed.value() * limits_.feed_factor;
  block.nominal2 = square(std::min(std::max(wanted, slowest), fastest));
  if (!blocks_.empty()) block.most_entry2 = std::min({junction2(direction), block.nominal2, nominal2_});
  blocks_.push_back(block);
  last_step_ = step;
  direction_ = direction;
  nominal2_ = block.nominal2;
  plan();
  return Seconds(std::max(when.value(), now_));
}

void GrblPlanner::each_chord(const Arc& arc, const Point& start, const Point& end, Mm tolerance,
                             const std::function<void(const Point&)>& add) {
  const double first = start[arc.first] + arc.first_center;
  const double second = start[arc.second] + arc.second_center;
  const double radius = std::hypot(arc.first_center, arc.second_center);
  const double from_first = -arc.first_center;
  const double from_second = -arc.second_center;
  const double to_first = end[arc.first] - first;
  const double to_second = end[arc.second] - second;
  double turn =
      std::atan2(from_first * to_second - from_second * to_first, from_first * to_first + from_second * to_second);
  if (arc.clockwise && turn >= -same_angle) turn -= 2 * std::numbers::pi;
  if (!arc.clockwise && turn <= same_angle) turn += 2 * std::numbers::pi;
  const double chord = std::sqrt(std::max(0.0, tolerance.value() * (2 * radius - tolerance.value())));
  const double chords = chord > 0 ? std::min(std::floor(std::abs(turn) / 2 * radius / chord), most_chords) : 1;
  for (double i = 1; i < chords; ++i) {
    Point place = start + (end - start) * (i / chords);
    const double cosine = std::cos(turn * i / chords);
    const double sine = std::sin(turn * i / chords);
    place[arc.first] = first + from_first * cosine - from_second * sine;
    place[arc.second] = second + from_first * sine + from_second * cosine;
    add(place);
  }
  add(end);
}

Seconds GrblPlanner::add_arc(const Arc& arc, const Point& end, MmPerSecond feed, std::uint32_t source, Seconds when) {
  const Point start = at_;
  each_chord(arc, start, end, limits_.arc_tolerance,
             [&](const Point& place) { when = add_line(place, feed, source, when); });
  return when;
}

Seconds GrblPlanner::wait_for_rest(Seconds dwell, Seconds when) {
  while (!blocks_.empty()) end_first(profile());
  now_ = std::max(now_, when.value()) + dwell.value();
  return Seconds(now_);
}

// From the last block back: each must be able to stop at the end of the last one.
void GrblPlanner::plan() {
  double exit2 = 0;
  for (std::size_t i = blocks_.size(); i-- > 1;) {
    Block& block = blocks_[i];
    const double entry2 = std::min(block.most_entry2, exit2 + block.gain2());
    if (entry2 == block.entry2 && i + 1 < blocks_.size()) return;
    block.entry2 = exit2 = entry2;
  }
}

Seconds GrblPlanner::rest_at() const {
  double time = now_;
  double speed = speed_;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Profile part = profile(i, i == 0 ? done_of_first_ : 0, speed);
    time += part.time();
    speed = part.exit;
  }
  return Seconds(time);
}

// Of a block, whose motion has come so far at this speed.
GrblPlanner::Profile GrblPlanner::profile(std::size_t index, double done, double speed) const {
  const Block& first = blocks_[index];
  const double acceleration = first.motion.acceleration.value();
  const double length = first.motion.length.value() - done;
  const double gain2 = 2 * acceleration * length;
  const double speed2 = square(speed);
  const double wanted2 = index + 1 < blocks_.size() ? blocks_[index + 1].entry2 : 0;
  // A plan never asks for more than the brakes give; only rounding does.
  const double exit2 = std::clamp(wanted2, std::max(0.0, speed2 - gain2), speed2 + gain2);
  const double top2 = std::max({std::min(first.nominal2, (speed2 + exit2 + gain2) / 2), speed2, exit2});
  const double rest = length - (2 * top2 - speed2 - exit2) / (2 * acceleration);
  Profile profile{.top = std::sqrt(top2), .exit = std::sqrt(exit2)};
  profile.up = (profile.top - speed) / acceleration;
  profile.down = (profile.top - profile.exit) / acceleration;
  profile.level = rest > 0 ? rest / profile.top : 0;
  return profile;
}

void GrblPlanner::run_until(double when) {
  while (!blocks_.empty() && now_ < when) {
    const Profile rest = profile();
    if (now_ + rest.time() > when) return move_first(rest, when - now_);
    end_first(rest);
  }
  if (blocks_.empty()) now_ = std::max(now_, when);
}

void GrblPlanner::move_first(const Profile& profile, double time) {
  const double acceleration = blocks_.front().motion.acceleration.value();
  const double up = std::min(time, profile.up);
  const double level = std::clamp(time - profile.up, 0.0, profile.level);
  add_phase(acceleration, up);
  add_phase(0, level);
  add_phase(-acceleration, time - up - level);
}

void GrblPlanner::add_phase(double acceleration, double time) {
  if (time <= 0) return;
  const GrblBlock& block = blocks_.front().motion;
  if (listener_) {
    listener_({.block = block,
               .begun = Seconds(now_),
               .duration = Seconds(time),
               .from = Mm(done_of_first_ * block.scale),
               .speed = MmPerSecond(speed_ * block.scale),
               .acceleration = MmPerSecond2(acceleration * block.scale)});
  }
  const double end_speed = speed_ + acceleration * time;
  done_of_first_ = std::min(done_of_first_ + (speed_ + end_speed) / 2 * time, block.length.value());
  speed_ = std::max(end_speed, 0.0);
  now_ += time;
}

void GrblPlanner::end_first(const Profile& profile) {
  move_first(profile, profile.time());
  speed_ = profile.exit;
  done_of_first_ = 0;
  blocks_.pop_front();
}

}  // namespace passo
