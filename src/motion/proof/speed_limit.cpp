#include "speed_limit.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

constexpr int values = 20'000;  // differs on purpose from the size of any other table

}  // namespace

SpeedLimit::SpeedLimit(const ProvenAxis& axis) : constant_(axis.acceleration.value()) {
  if (!axis.acceleration_at || !(axis.velocity > MmPerSecond(0))) return;
  const double step = axis.velocity.value() / values;
  per_step_ = 1 / step;
  for (int i = 0; i <= values; ++i) {
    const double limit = axis.acceleration_at(MmPerSecond(i * step)).value();
    table_.push_back(constant_ > 0 ? std::min(constant_, limit) : limit);
  }
}

double SpeedLimit::at(double speed) const {
  if (table_.empty()) return constant_;
  const double place = std::min(std::abs(speed) * per_step_, static_cast<double>(values));
  const auto below = std::min(static_cast<std::size_t>(place), table_.size() - 2);
  const double share = place - static_cast<double>(below);
  return table_[below] * (1 - share) + table_[below + 1] * share;
}

}  // namespace passo::proof
