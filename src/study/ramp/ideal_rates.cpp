#include "passo/ramp/ideal_rates.hpp"

#include <cmath>

namespace passo {

std::vector<IdealRate> ideal_rates(const RampRequest& request, double duration) {
  const double slope = request.setup.acceleration.value / step_angle(request.setup.steps_per_turn).value;
  const double first = first_interval(request.setup);
  const double top = request.rate > Hertz(0) ? request.rate.value() : HUGE_VAL;
  double lowest = 0;
  if (request.start > Hertz(0)) {
    if (top <= request.start.value()) return {{0, top}, {duration, top}};
    // The last index whose interval is inside the start/stop region: c_n = K_b (√(n+1) − √n).
    const double share = request.setup.clock.value() / request.start.value() / first;
    const double root = (1 - share * share) / (2 * share);
    const double index = std::floor(root * root);
    lowest = slope * first * std::sqrt(index) / request.setup.clock.value();
  }
  const double climb = (top - lowest) / slope;
  if (!request.whole_move) {
    if (climb >= duration) return {{0, lowest}, {duration, lowest + slope * duration}};
    return {{0, lowest}, {climb, top}, {duration, top}};
  }
  if (2 * climb >= duration) {
    return {{0, lowest}, {duration / 2, lowest + slope * duration / 2}, {duration, lowest}};
  }
  return {{0, lowest}, {climb, top}, {duration - climb, top}, {duration, lowest}};
}

}  // namespace passo
