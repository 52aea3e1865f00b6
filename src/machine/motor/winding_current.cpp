#include "passo/motor/winding_current.hpp"

#include <cmath>

#include <fmt/format.h>

namespace passo {

Amperes WindingCircuit::final() const {
  return {(supply.value - drop.value) / (winding.value + series.value)};
}

Seconds WindingCircuit::time_constant() const {
  return Seconds(inductance.value / (winding.value + series.value));
}

std::optional<Seconds> WindingCircuit::rise_time(Amperes current) const {
  const double part = current.value / final().value;
  if (part >= 1 || (limit && current > *limit)) return std::nullopt;
  return Seconds(-time_constant().value() * std::log1p(-part));
}

Status<MotorError> check(const WindingCircuit& circuit) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  const auto refuse = [](const char* what, double value, const char* unit) {
    return Failure{MotorError{fmt::format("{}, not {:g} {}", what, value, unit)}};
  };
  if (!positive(circuit.supply.value - circuit.drop.value)) {
    return refuse("the supply must be above the transistor's drop", circuit.supply.value, "V");
  }
  if (!(circuit.drop.value >= 0)) return refuse("the drop must be 0 V or more", circuit.drop.value, "V");
  if (!(circuit.diode.value >= 0)) return refuse("the diode's drop must be 0 V or more", circuit.diode.value, "V");
  if (!positive(circuit.winding.value)) return refuse("the resistance must be above 0", circuit.winding.value, "ohm");
  if (!(circuit.series.value >= 0)) {
    return refuse("the series resistor must be 0 ohm or more", circuit.series.value, "ohm");
  }
  if (!positive(circuit.inductance.value)) {
    return refuse("the inductance must be above 0", circuit.inductance.value, "H");
  }
  if (circuit.limit && !positive(circuit.limit->value)) {
    return refuse("the limit of the chopper must be above 0", circuit.limit->value, "A");
  }
  // Below a thousandth, a winding would switch thousands of times in each step.
  if (circuit.ripple == 0 || (circuit.ripple >= 0.001 && circuit.ripple <= 0.9)) return Unit{};
  return refuse("the ripple must be 0 or from 0.001 to 0.9", circuit.ripple, "of the limit");
}

void WindingCurrent::switch_to(double share) {
  share_ = share;
  pushes_ = share > 0 && !(circuit_.limit && current_ >= limit());
}

bool WindingCurrent::is_held() const {
  if (share_ == 0) return current_ == 0;
  return circuit_.limit && circuit_.ripple == 0 && current_ == limit();
}

WindingCurrent::Piece WindingCurrent::piece() const {
  if (pushes_) {
    Piece push{.end = circuit_.final().value, .tau = circuit_.time_constant().value()};
    if (!circuit_.limit) {
      push.end *= share_;
    } else if (push.end > limit()) {
      push.stop = limit();
    }
    return push;
  }
  const double tau = circuit_.inductance.value / circuit_.winding.value;
  const double lower = share_ == 0 ? 0 : limit() * (1 - circuit_.ripple);
  return {.end = -circuit_.diode.value / circuit_.winding.value, .tau = tau, .stop = lower};
}

double WindingCurrent::ripple_period() const {
  const double rests = -circuit_.diode.value / circuit_.winding.value;
  const double final = circuit_.final().value;
  const double lower = limit() * (1 - circuit_.ripple);
  const double fall =
      circuit_.inductance.value / circuit_.winding.value * std::log((limit() - rests) / (lower - rests));
  return fall + circuit_.time_constant().value() * std::log((final - lower) / (final - limit()));
}

void WindingCurrent::run(Seconds time) {
  for (double left = time.value(); left > 0 && !is_held();) {
    const auto [end, tau, stop] = piece();
    // Without a diode's drop the current gets ever nearer to 0, and never there.
    const bool reaches = stop && (current_ - *stop) * (*stop - end) > 0;
    const double until = reaches ? tau * std::log((current_ - end) / (*stop - end)) : HUGE_VAL;
    if (until >= left) {
      current_ = end + (current_ - end) * std::exp(-left / tau);
      return;
    }
    left -= until;
    current_ = *stop;
    const bool is_at_limit = share_ > 0 && pushes_;
    if (share_ > 0) pushes_ = !pushes_ && circuit_.ripple > 0;
    // From the limit on, each period of the ripple is as the one before. Whole periods end where they began, so a
    // chopper that switches millions of times costs no more than one that switches twice.
    if (is_at_limit && circuit_.ripple > 0) left = std::fmod(left, ripple_period());
  }
}

void WindingCurrent::settle() {
  if (share_ == 0) {
    current_ = 0;
  } else if (circuit_.limit && circuit_.final().value > limit()) {
    current_ = limit();
    pushes_ = false;
  } else {
    current_ = circuit_.final().value * (circuit_.limit ? 1 : share_);
  }
}

bool WindingCurrent::is_settled(Amperes full) const {
  if (is_held()) return true;
  const auto [end, tau, stop] = piece();
  const double goal = stop && share_ == 0 ? *stop : end;
  const bool may_switch = stop && share_ > 0;
  return !may_switch && std::abs(current_ - goal) < 1e-3 * full.value;
}

}  // namespace passo
