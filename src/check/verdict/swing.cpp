#include "swing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {

// The torque goes with the sine of the rotor's lag. The rotor starts at the lag for `before`. The way to the lag where
// the torque falls below `after` for good is π − asin(after/P). On the way the load's work may not exceed the torque's:
//
//   P·(cos δ0 + cos δ1) ≥ after·(π − δ1 − δ0)        δ0 = asin(before/P), δ1 = asin(after/P)
double torque_to_catch(double before, double after) {
  if (after < before) return torque_to_catch(-before, -after);
  const double least = std::max(std::abs(before), std::abs(after));
  if (!(least > 0)) return 0;
  const auto catches = [&](double most) {
    const double from = std::asin(before / most);
    const double to = std::asin(after / most);
    return most * (std::cos(from) + std::cos(to)) >= after * (std::numbers::pi - to - from);
  };
  if (catches(least)) return least;
  double low = least;
  double high = 2 * least;
  for (int i = 0; i < 16; ++i) {
    const double middle = (low + high) / 2;
    (catches(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace passo
