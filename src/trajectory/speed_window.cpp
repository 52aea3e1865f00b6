#include "speed_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
template <std::size_t most_corners>
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
  std::array<Corner, most_corners> corners_;
  std::size_t count_ = 4;
};

// What one demand leaves of x for a given y, and how its upper end moves with y.
struct Interval {
  double low = 0;
  double high = 0;
  double growth = 0;  // d high / d y

  // |p x + q y| <= limit
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
  // p x + q y <= limit
  void keep(double p, double q, double limit, double y) {
    const double bound = limit - q * y;
    if (p == 0) {
      if (bound < 0) high = -1;
    } else if (p < 0) {
      low = std::max(low, bound / p);
    } else if (bound / p < high) {
      high = bound / p;
      growth = -q / p;
    }
  }
};

// Each cut adds a corner at most; an axis makes four.
constexpr std::size_t corners_of_stripes = 4 + 4 * axis_count;

template <class AnyRegion>
void cut_stripes(std::span<const AxisDemand> demands, AnyRegion& region) {
  for (const AxisDemand& demand : demands) {
    region.cut(demand.entry_x, demand.entry_y, demand.limit);
    region.cut(-demand.entry_x, -demand.entry_y, demand.limit);
    region.cut(demand.exit_x, demand.exit_y, demand.limit);
    region.cut(-demand.exit_x, -demand.exit_y, demand.limit);
  }
}

void meet_stripes(std::span<const AxisDemand> demands, double y, Interval& x) {
  for (const AxisDemand& demand : demands) {
    x.meet(demand.entry_x, demand.entry_y, demand.limit, y);
    x.meet(demand.exit_x, demand.exit_y, demand.limit, y);
  }
}

// The line of each curve in use.
using Lines = std::array<std::uint32_t, axis_count>;

Lines lines_at(std::span<const FallingDemand> falling, double entry, double exit) {
  Lines lines{};
  for (std::size_t k = 0; k < falling.size(); ++k) {
    const double w = std::max(falling[k].entry_weight * entry, falling[k].exit_weight * exit);
    lines[k] = static_cast<std::uint32_t>(falling[k].curve->line_at(w));
  }
  return lines;
}

Lines kept_lines(std::span<const FallingDemand> falling) {
  Lines lines{};
  for (std::size_t k = 0; k < falling.size(); ++k) lines[k] = falling[k].line;
  return lines;
}

double limit_of(const FallingDemand& falling, std::uint32_t number) {
  const AccelerationCurve::Line& line = falling.curve->lines()[number];
  return std::max(line.at_rest - falling.slack - line.fall * falling.slack_of_fall, line.at_rest / 2);
}

// Calls keep(p, q, limit), for p x + q y <= limit, with each of the demands that the lines make.
template <class Keep>
void for_each_demand(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, const Lines& lines,
                     const Keep& keep) {
  for (std::size_t k = 0; k < falling.size(); ++k) {
    const FallingDemand& own = falling[k];
    const AxisDemand& demand = demands[own.demand];
    const AccelerationCurve::Line& line = own.curve->lines()[lines[k]];
    const double limit = limit_of(own, lines[k]);
    const double at_entry = line.fall * own.entry_weight;
    const double at_exit = line.fall * own.exit_weight;
    keep(at_entry + demand.entry_x, demand.entry_y, limit);
    keep(at_entry - demand.entry_x, -demand.entry_y, limit);
    keep(demand.exit_x, at_exit + demand.exit_y, limit);
    keep(-demand.exit_x, at_exit - demand.exit_y, limit);
  }
}

double largest_entry_with(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling,
                          const Lines& lines, double entry_most, double exit_most) {
  Interval at_most{.high = entry_most};
  meet_stripes(demands, exit_most, at_most);
  for_each_demand(demands, falling, lines,
                  [&](double p, double q, double limit) { at_most.keep(p, q, limit, exit_most); });
  if (at_most.low <= at_most.high && at_most.growth >= 0) return at_most.high;

  Region<corners_of_stripes + 4 * axis_count> region(entry_most, exit_most);
  cut_stripes(demands, region);
  for_each_demand(demands, falling, lines, [&](double p, double q, double limit) { region.cut(p, q, limit); });
  return region.largest_x();
}

// What the lines leave of the exit for a given entry.
Interval exits_with(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, const Lines& lines,
                    double entry, Interval exits) {
  for_each_demand(demands, falling, lines, [&](double p, double q, double limit) { exits.keep(q, p, limit, entry); });
  return exits;
}

// A step of the iteration is Newton's: two are nearly always enough.
constexpr int most_rounds = 5;

}  // namespace

double largest_entry(std::span<const AxisDemand> demands, double entry_most, double exit_most) {
  // Mostly what is left by braking as hard as can be: the best point lies on y = Y. The upper end of x is concave in y,
  // so that it is the best of all where it does not fall there.
  Interval at_most{.high = entry_most};
  meet_stripes(demands, exit_most, at_most);
  if (at_most.low <= at_most.high && at_most.growth >= 0) return at_most.high;

  Region<corners_of_stripes> region(entry_most, exit_most);
  cut_stripes(demands, region);
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

double largest_entry(std::span<const AxisDemand> demands, std::span<FallingDemand> falling, double entry_most,
                     double exit_most) {
  double best = -1;
  Lines used{};
  double entry = largest_entry(demands, entry_most, exit_most);
  for (int round = 0; round < most_rounds; ++round) {
    const Lines lines = lines_at(falling, entry, 0);
    if (round > 0 && lines == used) break;
    used = lines;
    entry = largest_entry_with(demands, falling, lines, entry_most, exit_most);
    if (!(entry > best)) continue;
    best = entry;
    for (std::size_t k = 0; k < falling.size(); ++k) falling[k].line = lines[k];
  }
  return best;
}

double largest_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry,
                    double exit_most, double top) {
  const Exits constant = exits(demands, entry);
  const Interval all{.low = constant.least, .high = std::min(constant.most, top)};
  double exit = all.high;
  double best = -1;
  Lines used{};
  Interval possible;
  for (int round = 0; round < most_rounds; ++round) {
    const Lines lines = lines_at(falling, entry, exit);
    if (round > 0 && lines == used) break;
    used = lines;
    const Interval left = exits_with(demands, falling, lines, entry, all);
    exit = std::max(left.high, 0.0);
    if (left.low > left.high || !(exit > best)) continue;
    best = exit;
    possible = left;
  }
  if (best >= 0 && best <= exit_most) return best;
  if (best >= 0 && possible.low <= exit_most + rounding * entry) return exit_most;

  // Braking as hard as can be, or harder than can be.
  const Interval fresh = exits_with(demands, falling, lines_at(falling, entry, exit_most), entry, all);
  const Interval kept = exits_with(demands, falling, kept_lines(falling), entry, all);
  const Interval& better = kept.low <= kept.high && kept.low < fresh.low ? kept : fresh;
  const bool too_fast = better.low > exit_most + rounding * entry && better.low <= better.high;
  return too_fast ? better.low : std::max(0.0, std::min(exit_most, better.high));
}

double least_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry) {
  if (falling.empty()) return least_exit(demands, entry);
  return largest_exit(demands, falling, entry, 0, entry);
}

// The limit at the entry is the lowest on the way to rest.
double sure_deceleration(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double length,
                         double entry) {
  double most = sure_deceleration(demands, length, entry);
  const Lines lines = lines_at(falling, entry, entry);
  for (std::size_t k = 0; k < falling.size(); ++k) {
    const FallingDemand& own = falling[k];
    AxisDemand lowered = demands[own.demand];
    const double w = std::max(own.entry_weight, own.exit_weight) * entry;
    lowered.limit = limit_of(own, lines[k]) - own.curve->lines()[lines[k]].fall * w;
    most = std::min(most, sure_deceleration({&lowered, 1}, length, entry));
  }
  return most;
}

}  // namespace passo
