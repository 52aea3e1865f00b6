#include "passo/plant/screw_model.hpp"

#include <algorithm>

namespace passo {

double ScrewModel::slide_at(double nut) const {
  if (errors.empty()) return nut;
  if (nut <= errors.front().at) return nut + errors.front().off;
  if (nut >= errors.back().at) return nut + errors.back().off;
  const auto next = std::ranges::upper_bound(errors, nut, {}, &Error::at);
  const Error& before = *(next - 1);
  const double share = (nut - before.at) / (next->at - before.at);
  return nut + before.off + share * (next->off - before.off);
}

void Screws::fit(std::size_t motor, const ScrewModel& model, double position) {
  std::erase_if(fitted_, [&](const Fitted& one) { return one.motor == motor; });
  fitted_.push_back({.motor = motor, .model = model, .nut = position});
}

bool Screws::any_backlash() const {
  return std::ranges::any_of(fitted_, [](const Fitted& one) { return one.model.backlash != 0; });
}

void Screws::follow(const MotorPositions& motors, MotorPositions& slides) {
  slides = motors;
  for (Fitted& one : fitted_) {
    const double motor = motors[one.motor];
    const double backlash = one.model.backlash;
    one.nut = std::clamp(one.nut, motor + std::min(backlash, 0.0), motor + std::max(backlash, 0.0));
    slides[one.motor] = one.model.slide_at(one.nut);
  }
}

void Screws::stand_at(const MotorPositions& motors, MotorPositions& slides) {
  for (Fitted& one : fitted_) one.nut = motors[one.motor];
  follow(motors, slides);
}

std::int64_t Screws::motor_steps_for(std::int64_t steps) const {
  if (any_backlash()) return 1;
  if (fitted_.empty() || steps == INT64_MAX) return steps;
  // A slide is faster than its motor by less than a hundredth.
  return std::max<std::int64_t>(1, steps - steps / 100 - 1);
}

}  // namespace passo
