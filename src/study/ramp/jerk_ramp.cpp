#include "jerk_ramp.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace passo {
namespace {

// With an end speed, the last step runs at that speed. So does the first step from rest.
double last_step(const JerkLimits& limits) {
  return limits.end_speed > 0 ? 1 : 0;
}

JerkPhases tail_to(double crest, const JerkLimits& limits) {
  JerkPhases tail;
  tail.add_way(last_step(limits), limits.end_speed);
  tail.add_change({limits.end_speed, 0}, crest, limits);
  return tail;
}

JerkPhases head_to(double crest, const JerkState& from, double lead, const JerkLimits& limits) {
  JerkPhases head;
  head.add_way(lead, from.speed);
  head.add_change(from, crest, limits);
  return head;
}

}  // namespace

void JerkPhases::add(const ConstantJerk& motion, double duration) {
  if (!(duration > 0)) return;
  assert(count_ < most);
  phases_[count_++] = {.motion = motion, .start = way_, .start_time = duration_, .duration = duration};
  way_ += motion.way_after(duration);
  duration_ += duration;
}

void JerkPhases::add_way(double way, double speed) {
  if (way > 0) add({speed, 0, 0}, way / speed);
}

void JerkPhases::add_change(const JerkState& from, double speed, const JerkLimits& limits) {
  const double a = from.acceleration;
  // The speed that remains after the acceleration went back to 0. It tells whether to speed up or to brake.
  const double straight = from.speed + a * std::abs(a) / (2 * limits.jerk);
  const double sign = speed >= straight ? 1 : -1;
  const double change = sign * (speed - from.speed);
  const double jerk = sign * limits.jerk;

  const double peak = std::sqrt(std::max(limits.jerk * change + a * a / 2, 0.0));
  const double top = std::max(std::min(peak, limits.acceleration), sign * a);
  const double rising = (top - sign * a) / limits.jerk;
  const double falling = top / limits.jerk;
  const double gained = (2 * top * top - a * a) / (2 * limits.jerk);
  const double holding = peak > limits.acceleration ? (change - gained) / top : 0;

  const ConstantJerk first{from.speed, a, jerk};
  add(first, rising);
  const double before = speed - sign * top * falling / 2;  // the speed at the start of the last phase
  add({before - sign * top * std::max(holding, 0.0), sign * top, 0}, holding);
  add({before, sign * top, -jerk}, falling);
}

JerkPhases::Found JerkPhases::find(double way) const {
  const Phase* phase = phases_.data();
  for (std::size_t i = 1; i < count_ && phases_[i].start < way; ++i) phase = &phases_[i];
  return {phase, phase->motion.time_to(way - phase->start, phase->duration)};
}

double JerkPhases::time_at(double way) const {
  if (count_ == 0) return 0;
  const Found found = find(way);
  return found.phase->start_time + found.time;
}

JerkState JerkPhases::state_at(double way) const {
  const Found found = find(way);
  return {found.phase->motion.speed_after(found.time), found.phase->motion.acceleration_after(found.time)};
}

void JerkRamp::climb(const JerkState& from, double lead, const JerkLimits& limits) {
  const auto needed = [&](double crest) {
    return head_to(crest, from, lead, limits).way() + tail_to(crest, limits).way();
  };
  double low = limits.end_speed;
  double high = std::max({limits.end_speed, from.speed, 1.0});
  while (high < limits.speed && needed(high) < way_) high *= 2;
  high = std::max(std::min(high, limits.speed), low);
  if (needed(high) <= way_) {
    low = high;
  } else {
    for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2) {
      (needed(middle) <= way_ ? low : high) = middle;
    }
  }
  crest_ = low;
  head_ = head_to(crest_, from, lead, limits);
  tail_ = tail_to(crest_, limits);
  const double rest = std::max(way_ - head_.way() - tail_.way(), 0.0);
  duration_ = head_.duration() + (rest > 0 && crest_ > 0 ? rest / crest_ : 0) + tail_.duration();
}

JerkRamp::JerkRamp(const JerkState& from, double way, const JerkLimits& limits) : way_(way) {
  climb(from, 0, limits);
}

JerkRamp JerkRamp::from_rest(double way, const JerkLimits& limits) {
  JerkRamp profile;
  profile.way_ = way;
  const double ends = 2 * last_step(limits);
  if (limits.end_speed > 0 && (way <= ends || limits.speed <= limits.end_speed)) {
    profile.crest_ = limits.end_speed;
    profile.duration_ = way / profile.crest_;
    return profile;
  }
  profile.climb({limits.end_speed, 0}, last_step(limits), limits);
  return profile;
}

double JerkRamp::shortest(const JerkState& from, const JerkLimits& limits) {
  return head_to(limits.end_speed, from, 0, limits).way() + last_step(limits);
}

double JerkRamp::time_at(double way) const {
  const double rest = way_ - way;
  if (rest < tail_.way() || rest <= 0) return duration_ - tail_.time_at(rest);
  if (way <= head_.way()) return head_.time_at(way);
  return head_.duration() + (way - head_.way()) / crest_;
}

JerkState JerkRamp::state_at(double way) const {
  const double rest = way_ - way;
  if (rest < tail_.way()) {
    const JerkState backwards = tail_.state_at(rest);
    return {backwards.speed, -backwards.acceleration};
  }
  if (way < head_.way()) return head_.state_at(way);
  return {crest_, 0};
}

}  // namespace passo
