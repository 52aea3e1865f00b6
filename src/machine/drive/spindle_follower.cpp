#include "passo/drive/spindle_follower.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace passo {
namespace {

// In seconds: the time over which the speed is measured. A shorter time is rough, because the encoder gives whole
// counts. A longer time is late.
constexpr double measured_over = 0.03;
constexpr std::size_t least_readings = 4;  // a slow line brings no more in that time

// The rate, in 1/s, at which an error of place is made up for. The rate is slow compared with the time from a reading
// to its effect.
constexpr double eagerness = 15;

// Half the time that the move planned next takes.
constexpr Seconds half_a_move{0.001};

// In turns: after this way the tool has made up for its start.
constexpr double lead_in = 4;

// The tool is up to speed, and its place counts, from this part of the spindle's speed on.
constexpr double up_to_speed = 0.95;
// The tool goes with the spindle, and does not brake for the end of the move, from this part of the spindle's speed on.
constexpr double most_of_it = 0.8;

// Under a limit of jerk, the smallest changes of the ratio that are made: while the tool speeds up, and after that.
constexpr double coarse = 0.05;
constexpr double fine = 0.002;

}  // namespace

SpindleFollower::SpindleFollower(const MotionLimits& limits) : limits_(limits) {
  for (const Axis axis : all_axes) {
    const double jerk = limits.jerk[axis].value();
    if (jerk > 0) patience_ = std::max(patience_, limits.acceleration[axis].value() / jerk);
  }
}

void SpindleFollower::restart() {
  readings_.clear();
  changed_at_ = -1;
}

void SpindleFollower::begin(double index) {
  index_ = index;
  way_ = turns_per_second() < 0 ? -1 : 1;
  lag_ = -1;
  followed_ = reached_ = 0;
  direction_ = 1;
  in_place_ = false;
}

void SpindleFollower::watch(const PlannedMove& move) {
  lock_ = move.segment.lock;
  if (lock_ == SpindleLock::none) return;
  const double pitch = move.segment.pitch.value();
  programmed_ = move.segment.speed.value() / pitch;
  most_turns_ = speed_within(move.segment.curve.steepest_bound(), fastest, limits_) / pitch;
  if (lag_ < 0) lag_ = lag_of(move);
  followed_ += direction_ * (move.to - move.from()).value() / pitch;
  reached_ = move.exit_velocity().value() / pitch;
  in_place_ = in_place_ || reached_ >= up_to_speed * speed();
}

void SpindleFollower::read(const SpindleReading& reading) {
  if (!readings_.empty() && reading.time <= readings_.back().time) return;
  readings_.push_back(reading);
  while (readings_.size() > least_readings && (reading.time - readings_[1].time).value() >= measured_over)
    readings_.pop_front();
}

double SpindleFollower::turns_per_second() const {
  if (readings_.size() < 2) return 0;
  const SpindleReading& from = readings_.front();
  const SpindleReading& to = readings_.back();
  return (to.turns - from.turns) / (to.time - from.time).value();
}

// At an even acceleration, or with a limit of jerk at an even mean one, the tool loses half of the way.
double SpindleFollower::lag_of(const PlannedMove& move) const {
  const Point direction = move.segment.curve.tangent(move.from());
  double acceleration = strongest;
  double jerk = std::numeric_limits<double>::infinity();
  for (const Axis axis : all_axes) {
    const double part = std::abs(direction[axis]);
    if (!(part > 0)) continue;
    if (limits_.acceleration[axis].value() > 0) {
      acceleration = std::min(acceleration, limits_.acceleration[axis].value() / part);
    }
    if (limits_.jerk[axis].value() > 0) jerk = std::min(jerk, limits_.jerk[axis].value() / part);
  }
  const double v = move.segment.speed.value();
  const bool has_full = v * jerk >= acceleration * acceleration;
  const double time = has_full ? v / acceleration + acceleration / jerk : 2 * std::sqrt(v / jerk);
  return v * time / 2 / move.segment.pitch.value();
}

std::optional<double> SpindleFollower::ratio(Seconds committed) {
  const double time = readings_.empty() ? 0 : readings_.back().time.value();
  const double wanted = wanted_ratio(committed);
  const bool same = std::abs(wanted - ratio_) < (in_place_ ? fine : coarse) * ratio_;
  if (patience_ > 0 && (same || time < changed_at_ + patience_)) return std::nullopt;
  changed_at_ = time;
  return ratio_ = wanted;
}

// Fits a parabola to the readings by least squares, because a spindle that is reversed changes its speed evenly.
SpindleFollower::Course SpindleFollower::course(Seconds later) const {
  const double last = readings_.back().time.value();
  const auto turns_of = [this](const SpindleReading& reading) { return way_ * (reading.turns - index_); };
  const double base = turns_of(readings_.back());
  std::array<double, 5> powers{};
  std::array<double, 3> right{};
  for (const SpindleReading& reading : readings_) {
    const double t = (reading.time.value() - last) / measured_over;
    double power = 1;
    for (std::size_t i = 0; i < powers.size(); ++i, power *= t) {
      powers[i] += power;
      if (i < right.size()) right[i] += power * (turns_of(reading) - base);
    }
  }
  const auto [s0, s1, s2, s3, s4] = powers;
  const auto determinant = [](double a, double b, double c, double d, double e, double f, double g, double h,
                              double i) { return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g); };
  const double whole = determinant(s0, s1, s2, s1, s2, s3, s2, s3, s4);
  const double at = later.value() / measured_over;
  if (readings_.size() < 4 || std::abs(whole) < 1e-9) return {base + speed() * later.value(), speed()};
  const auto [r0, r1, r2] = right;
  const double c0 = determinant(r0, s1, s2, r1, s2, s3, r2, s3, s4) / whole;
  const double c1 = determinant(s0, r0, s2, s1, r1, s3, s2, r2, s4) / whole;
  const double c2 = determinant(s0, s1, r0, s1, s2, r1, s2, s3, r2) / whole;
  return {base + c0 + at * (c1 + at * c2), (c1 + 2 * c2 * at) / measured_over};
}

bool SpindleFollower::is_reversing(Seconds committed) const {
  return readings_.size() > 2 && course(committed).speed < least_ratio * programmed_;
}

double SpindleFollower::missing(Seconds committed) const {
  const bool goes_with_it = in_place_ && reached_ > most_of_it * speed();
  if (!goes_with_it || followed_ < lead_in || readings_.size() < least_readings) return 0;
  return course(committed).turns - lag_ - followed_;
}

bool SpindleFollower::outruns_axes(Seconds committed) const {
  const double there = in_place_ ? direction_ * course(committed).speed : speed();
  return up_to_speed * there > std::min(most_turns_, most_ratio * programmed_);
}

double SpindleFollower::wanted_ratio(Seconds committed) const {
  if (lock_ == SpindleLock::place && in_place_ && programmed_ > 0) {
    const Course there = course(committed + half_a_move);
    const double missing = there.turns - lag_ - followed_;
    return std::clamp(direction_ * (there.speed + eagerness * missing) / programmed_, least_ratio, most_ratio);
  }
  if (!(speed() > 0) || !(programmed_ > 0)) return 1;
  return std::clamp(speed() / programmed_, least_ratio, most_ratio);
}

}  // namespace passo
