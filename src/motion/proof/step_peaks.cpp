#include "step_peaks.hpp"

#include <algorithm>
#include <cmath>

#include "passo/wire/segment_parts.hpp"

namespace passo::proof {
namespace {

constexpr double window = 0.010;  // seconds
constexpr std::int64_t half_step = 32768;

std::int64_t signed_increment(const BoardSegment& segment, std::size_t m) {
  const bool flip = (segment.flips >> m & 1U) != 0;
  const bool down = (segment.directions >> m & 1U) != 0;
  const std::int64_t sent = segment.increments[m];
  if (flip) return down ? sent - 65536 : 65536;
  return down ? 0 : sent;
}

}  // namespace

StepPeaks::StepPeaks(const ProofOptions& options, MotionProof& proof)
    : proof_(proof),
      place_(options.axes.size(), half_step),
      tick_rate_(options.tick_rate.value()),
      between_samples_(std::llround(window / samples_in_window * options.tick_rate.value() * 65536)),
      counts_(options.axes.size()) {
  for (std::size_t m = 0; m < options.axes.size(); ++m) {
    step_.push_back(options.axes[m].step.value());
    limits_.emplace_back(options.axes[m]);
    start_stop_.push_back(options.axes[m].start_stop.value());
    proof_.axes[m].step_velocity_noise = 2 * step_[m] / window;
    proof_.axes[m].step_acceleration_noise = 4 * step_[m] / (window * window);
  }
}

void StepPeaks::watch(const BoardSegment& segment) {
  std::array<std::int64_t, max_motors> increments{};
  for (std::size_t m = 0; m < place_.size(); ++m) increments[m] = signed_increment(segment, m);
  for_each_part(segment, [&](const PartTimes& part, unsigned events, unsigned /*before*/) {
    std::int64_t interval = part.interval;
    for (unsigned k = 0; k < events; ++k) {
      time_ += interval;
      interval += part.change;
      while (next_sample_ <= time_) sample();
      for (std::size_t m = 0; m < place_.size(); ++m) place_[m] += increments[m];
    }
  });
}

// After the last step the machine rests.
void StepPeaks::finish() {
  for (std::size_t i = 0; i < kept; ++i) sample();
}

void StepPeaks::sample() {
  for (std::size_t m = 0; m < place_.size(); ++m) {
    // Before the first sample the machine rested.
    if (sampled_ == 0) counts_[m].fill(place_[m] >> 16);
    counts_[m][sampled_ % kept] = place_[m] >> 16;
    difference(m);
  }
  ++sampled_;
  next_sample_ += between_samples_;
}

std::int64_t StepPeaks::before(std::size_t m, std::size_t samples) const {
  return counts_[m][(sampled_ + kept - samples) % kept];
}

void StepPeaks::difference(std::size_t m) {
  const std::int64_t here = before(m, 0);
  const std::int64_t middle = before(m, samples_in_window);
  const std::int64_t first = before(m, 2 * samples_in_window);
  const auto raise = [&](Finding& finding, double value, double age) {
    if (!(value > finding.value)) return;
    finding.value = value;
    finding.time = Seconds(static_cast<double>(next_sample_) / 65536 / tick_rate_ - age);
  };
  AxisProof& axis = proof_.axes[m];
  raise(axis.step_velocity, static_cast<double>(std::abs(here - middle)) * step_[m] / window, window / 2);
  const double faster = static_cast<double>(std::max(std::abs(here - middle), std::abs(middle - first)));
  const double of_rests = of_jumps(m, faster * step_[m] / window);
  const double bend = static_cast<double>(std::abs(here - 2 * middle + first)) * step_[m] / (window * window);
  const double acceleration = std::max(bend - of_rests, 0.0);
  if (limits_[m].falls()) {
    const double slower = static_cast<double>(std::min(std::abs(here - middle), std::abs(middle - first)));
    const double least = (slower - 2) * step_[m] / window - limits_[m].constant() * window;
    const double limit = limits_[m].at(of_rests > 0 ? 0.0 : std::max(least, 0.0));
    const double noise = axis.step_acceleration_noise;
    if (!(acceleration * (axis.step_acceleration.limit + noise) > axis.step_acceleration.value * (limit + noise)))
      return;
    axis.step_acceleration.limit = limit;
    axis.step_acceleration.value = 0;
  }
  raise(axis.step_acceleration, acceleration, window);
}

// How much of the mean acceleration the jumps at rests may have done. `faster`: the mean velocity of the faster half.
double StepPeaks::of_jumps(std::size_t m, double faster) const {
  const double velocity = start_stop_[m];
  const double rounding = 2 * step_[m] / window;
  const bool slow = faster <= velocity + 2 * window * limits_[m].constant() + rounding;
  return velocity > 0 && slow ? 2 * velocity / window : 0;
}

}  // namespace passo::proof
