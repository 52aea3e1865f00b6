#include "speed_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace passo {
namespace {

// Of squares of speeds, relative: less is what arithmetic makes of equal ones.
constexpr double rounding = 1e-9;

struct Corner {
  double x = 0;
  double y = 0;
};

// A convex region: the rectangle, cut by one half plane after the other (Sutherland and Hodgman).
class Region {
 public:
  Region(double width, double height) : corners_{{{0, 0}, {width, 0}, {width, height}, {0, height}}} {}

  // Keeps p x + q y <= limit.
  void cut(double p, double q, double limit) {
    std::array<Corner, most_corners> kept;
    std::size_t count = 0;
    Corner from = corners_[count_ - 1];
    double excess_from = p * from.x + q * from.y - limit;
    for (std::size_t i = 0; i < count_; ++i) {
      const Corner to = corners_[i];
      const double excess = p * to.x + q * to.y - limit;
      if ((excess > 0) != (excess_from > 0)) {
        const double share = excess_from / (excess_from - excess);
        kept[count++] = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
      }
      if (!(excess > 0)) kept[count++] = to;
      from = to;
      excess_from = excess;
    }
    // The origin meets every demand: something is always left.
    corners_ = kept;
    count_ = count;
  }

  double largest_x() const {
    double most = 0;
    for (std::size_t i = 0; i < count_; ++i) most = std::max(most, corners_[i].x);
    return most;
  }

 private:
  // Each of four cuts an axis adds a corner at most.
  static constexpr std::size_t most_corners = 4 + 4 * axis_count;
  std::array<Corner, most_corners> corners_;
  std::size_t count_ = 4;
};

// What one demand leaves of x for a given y, and how its upper end moves with y.
struct Interval {
  double low = 0;
  double high = 0;
  double growth = 0;  // d high / d y

  void meet(double p, double q, double limit, double y) {
    if (p == 0) {
      if (std::max(q * y, -q * y) > limit) high = -1;
      return;
    }
    const double toward = p > 0 ? 1 : -1;
    const double up = (toward * limit - q * y) / p;
    const double down = (-toward * limit - q * y) / p;
    low = std::max(low, down);
    if (up < high) {
      high = up;
      growth = -q / p;
    }
  }
};

}  // namespace

double largest_entry(std::span<const AxisDemand> demands, double entry_most, double exit_most) {
  // Mostly what is left by braking as hard as can be: the best point lies on y = Y. The upper end of x is concave in y,
  // so that it is the best of all where it does not fall there.
  Interval at_most{.high = entry_most};
  for (const AxisDemand& demand : demands) {
    at_most.meet(demand.entry_x, demand.entry_y, demand.limit, exit_most);
    at_most.meet(demand.exit_x, demand.exit_y, demand.limit, exit_most);
  }
  if (at_most.low <= at_most.high && at_most.growth >= 0) return at_most.high;

  Region region(entry_most, exit_most);
  for (const AxisDemand& demand : demands) {
    region.cut(demand.entry_x, demand.entry_y, demand.limit);
    region.cut(-demand.entry_x, -demand.entry_y, demand.limit);
    region.cut(demand.exit_x, demand.exit_y, demand.limit);
    region.cut(-demand.exit_x, -demand.exit_y, demand.limit);
  }
  return region.largest_x();
}

namespace {

// What the demands leave of y for a given x.
struct Exits {
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};
Exits exits(std::span<const AxisDemand> demands, double entry) {
  Exits left;
  for (const AxisDemand& demand : demands) {
    for (const auto& [p, q] : {std::pair(demand.entry_x, demand.entry_y), std::pair(demand.exit_x, demand.exit_y)}) {
      if (q == 0) continue;
      const double toward = q > 0 ? 1 : -1;
      left.most = std::min(left.most, (toward * demand.limit - p * entry) / q);
      left.least = std::max(left.least, (-toward * demand.limit - p * entry) / q);
    }
  }
  return left;
}

}  // namespace

double largest_exit(std::span<const AxisDemand> demands, double entry, double exit_most) {
  const Exits left = exits(demands, entry);
  // On the edge of what is possible rounding may leave nothing at all; then what is slower is right.
  const double least = std::min(left.least, left.most);
  const double most = std::min(left.most, exit_most);
  return std::max(0.0, least > most + rounding * entry ? least : most);
}

double least_exit(std::span<const AxisDemand> demands, double entry) {
  const Exits left = exits(demands, entry);
  return std::max(0.0, std::min(left.least, left.most));
}

double sure_deceleration(std::span<const AxisDemand> demands, double length, double entry) {
  double most = std::numeric_limits<double>::infinity();
  for (const AxisDemand& demand : demands) {
    const double slope = 2 * length * std::max(std::abs(demand.entry_y), std::abs(demand.exit_x));
    const double bend = std::max(std::abs(demand.entry_x + demand.entry_y), std::abs(demand.exit_x + demand.exit_y));
    if (slope > 0) most = std::min(most, (demand.limit - bend * entry) / slope);
  }
  return most;
}

}  // namespace passo
