#include "speed_limit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo::proof {
namespace {

constexpr int values = 20'000;  // differs on purpose from the size of any other table

}  // namespace

SpeedLimit::SpeedLimit(const ProvenAxis& axis) : constant_(axis.acceleration.value()) {
  if (!axis.acceleration_at || !(axis.velocity > MmPerSecond(0))) return;
  const double step = axis.velocity.value() / values;
  per_step_ = 1 / step;
  std::vector<double> table;
  table.reserve(values + 1);
  for (int i = 0; i <= values; ++i) {
    const double limit = axis.acceleration_at(MmPerSecond(i * step)).value();
    table.push_back(constant_ > 0 ? std::min(constant_, limit) : limit);
  }
  table_ = std::make_shared<const std::vector<double>>(std::move(table));
}

double SpeedLimit::at(double speed) const {
  if (!table_) return constant_;
  const std::vector<double>& table = *table_;
  const double place = std::min(std::abs(speed) * per_step_, static_cast<double>(values));
  const auto below = std::min(static_cast<std::size_t>(place), table.size() - 2);
  const double share = place - static_cast<double>(below);
  return table[below] * (1 - share) + table[below + 1] * share;
}

std::vector<SpeedLimit> speed_limits(const std::vector<ProvenAxis>& axes) {
  std::vector<SpeedLimit> limits;
  for (const ProvenAxis& axis : axes) limits.emplace_back(axis);
  return limits;
}

}  // namespace passo::proof
