#include "passo/feedback/loop_trial.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

constexpr double settled_within = 0.05;  // of the jump
constexpr double last_part = 0.1;        // of the time

struct Extent {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  double sum = 0;
  std::size_t count = 0;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
    sum += value;
    ++count;
  }
  double width() const { return count > 0 ? high - low : 0; }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

Extent extent_of(const std::vector<LoopMoment>& moments, double from, double to) {
  Extent extent;
  const double whole = moments.back().time.value();
  for (const LoopMoment& moment : moments) {
    const double at = moment.time.value() / whole;
    if (at >= from && at <= to) extent.add(moment.is);
  }
  return extent;
}

// The time between crossings of the mean, upwards. 0: there are no two.
double period_of(const std::vector<LoopMoment>& moments, double from) {
  const double mean = extent_of(moments, from, 1).mean();
  double first = 0;
  double last = 0;
  int crossings = 0;
  for (std::size_t i = 1; i < moments.size(); ++i) {
    if (moments[i].time.value() < from * moments.back().time.value()) continue;
    if (moments[i - 1].is >= mean || moments[i].is < mean) continue;
    last = moments[i].time.value();
    if (crossings++ == 0) first = last;
  }
  return crossings > 1 ? (last - first) / (crossings - 1) : 0;
}

// With P alone. A swing that neither fades nor is the noise of the counts.
bool swings(const LoopSetup& setup, double gain, double& period) {
  constexpr Seconds whole{0.6};
  constexpr double fades = 0.85;
  constexpr double notable = 0.25;
  LoopSetup trial = setup;
  trial.gains = {.kp = gain};
  trial.load = {};
  const std::vector<LoopMoment> moments = step_response(trial, whole);
  const double before = extent_of(moments, 0.4, 0.65).width();
  const double after = extent_of(moments, 0.75, 1).width();
  period = period_of(moments, 0.5);
  return after > notable * std::abs(setup.to) && after >= fades * before && period > 0;
}

}  // namespace

std::vector<LoopMoment> step_response(const LoopSetup& setup, Seconds whole) {
  const ShaftEncoder encoder(setup.counts_per_turn);
  ServoMotor motor(setup.motor, encoder, setup.period);
  CountedSpeed counted(encoder, setup.period, setup.smoothing);
  const bool places = setup.controlled == Controlled::position;
  Pid outer(setup.gains, setup.period, setup.fastest.value);
  Pid inner(places ? setup.speed_gains : setup.gains, setup.period, motor.most_torque().value);
  std::vector<LoopMoment> moments;
  const auto count = static_cast<std::int64_t>(std::llround(whole / setup.period));
  // A shaft that rests on the border of two counts would begin with an error.
  const double first = encoder.radians_of(motor.counts());
  for (std::int64_t i = 0; i <= count; ++i) {
    const Seconds now = setup.period * static_cast<double>(i);
    if (setup.load.value > 0 && now >= setup.load_at) motor.set_resistance(setup.load);
    const double speed = counted.update(motor.counts());
    const double place = encoder.radians_of(motor.counts()) - first;
    const double wanted_speed = places ? outer.update(setup.to, place) : setup.to;
    const NewtonMetres asked{inner.update(wanted_speed, speed)};
    moments.push_back({.time = now,
                       .wanted = setup.to,
                       .counted = places ? place : speed,
                       .is = places ? motor.radians() : motor.speed().value,
                       .speed = motor.speed(),
                       .asked = asked,
                       .torque = motor.torque()});
    motor.run(asked, {speed});
  }
  return moments;
}

LoopFigures figures_of(const std::vector<LoopMoment>& all, const LoopSetup& setup) {
  LoopFigures figures;
  std::vector<LoopMoment> moments = all;
  if (setup.load.value > 0) {
    std::erase_if(moments, [&](const LoopMoment& moment) { return moment.time >= setup.load_at; });
  }
  if (moments.empty() || setup.to == 0) return figures;
  std::optional<Seconds> tenth;
  for (const LoopMoment& moment : moments) {
    const double share = moment.is / setup.to;
    if (!tenth && share >= 0.1) tenth = moment.time;
    if (!figures.rise && share >= 0.9) figures.rise = moment.time - tenth.value_or(Seconds(0));
    figures.overshoot = std::max(figures.overshoot, share - 1);
    if (std::abs(share - 1) > settled_within) {
      figures.settled.reset();
    } else if (!figures.settled) {
      figures.settled = moment.time;
    }
  }
  const Extent end = extent_of(moments, 1 - last_part, 1);
  figures.error = setup.to - end.mean();
  figures.swing = end.width();
  return figures;
}

std::optional<UltimateCycle> ultimate_cycle(const LoopSetup& whole) {
  LoopSetup setup = whole;
  // A large jump of the place would meet the limits of speed and torque, which hide the swing.
  constexpr double small_turn = 0.05;
  if (setup.controlled == Controlled::position) setup.to = std::min(std::abs(setup.to), small_turn);
  // From the weakest gain that could matter: full torque for a thousand times the jump.
  const double unit =
      setup.controlled == Controlled::speed
          ? ServoMotor(setup.motor, ShaftEncoder(setup.counts_per_turn), setup.period).most_torque().value /
                std::abs(setup.to)
          : 1;
  constexpr double weakest = 1e-3;
  constexpr double strongest = 1e6;
  constexpr int halvings = 12;
  double period = 0;
  double high = weakest * unit;
  while (!swings(setup, high, period)) {
    high *= 2;
    if (high > strongest * unit) return std::nullopt;
  }
  double low = high / 2;
  UltimateCycle cycle{.gain = high, .period = Seconds(period)};
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    if (swings(setup, middle, period)) {
      high = middle;
      cycle = {.gain = middle, .period = Seconds(period)};
    } else {
      low = middle;
    }
  }
  return cycle;
}

}  // namespace passo
