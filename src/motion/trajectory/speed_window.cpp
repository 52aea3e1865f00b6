#include "speed_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "arithmetic.hpp"

namespace passo {
namespace {

// Has no initial values: most corners that there is room for are never used.
struct SpeedCorner {
  double x;
  double y;
};

// A convex region: the rectangle, cut by one half plane after the other (Sutherland and Hodgman).
template <std::size_t most_corners>
class SpeedRegion {
 public:
  SpeedRegion(double width, double height) {
    corners_[0] = {0, 0};
    corners_[1] = {width, 0};
    corners_[2] = {width, height};
    corners_[3] = {0, height};
  }

  // Keeps p x + q y <= limit. Most cuts take nothing away.
  void cut(double p, double q, double limit) {
    const auto end = corners_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto is_beyond = [&](const SpeedCorner& corner) { return p * corner.x + q * corner.y - limit > 0; };
    if (std::none_of(corners_.begin(), end, is_beyond)) return;
    std::array<SpeedCorner, most_corners> kept;
    std::size_t count = 0;
    SpeedCorner from = corners_[count_ - 1];
    double excess_from = p * from.x + q * from.y - limit;
    for (std::size_t i = 0; i < count_; ++i) {
      const SpeedCorner to = corners_[i];
      const double excess = p * to.x + q * to.y - limit;
      if ((excess > 0) != (excess_from > 0)) {
        const double share = excess_from / (excess_from - excess);
        kept[count++] = {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
      }
      if (!(excess > 0)) kept[count++] = to;
      from = to;
      excess_from = excess;
    }
    // The origin meets every demand, so something is always left.
    std::copy_n(kept.begin(), count, corners_.begin());
    count_ = count;
  }

  double largest_x() const {
    double most = 0;
    for (std::size_t i = 0; i < count_; ++i) most = std::max(most, corners_[i].x);
    return most;
  }

 private:
  std::array<SpeedCorner, most_corners> corners_;
  std::size_t count_ = 4;
};

// The range of x that the demands allow for a given y, empty if low is above high. Most demands allow everything, which
// shows without a division: a number above a rounded product, divided by one factor, is not below the other factor.
struct Interval {
  double low = 0;
  double high = 0;
  // By how much a larger y lowers either end.
  double low_fall = 0;
  double fall = 0;

  bool is_empty() const { return low > high; }
  bool shrinks() const { return fall > 0; }

  // Keeps |p x + q y| <= limit. With p = 0 nothing is left where that does not hold.
  void meet(double p, double q, double limit, double y) {
    const double toward = std::copysign(1.0, p);
    const double steep = toward * p;
    const double shift = toward * q;
    const double up = limit - shift * y;
    const double down = -limit - shift * y;
    if (!(down < low * steep) && down / steep > low) {
      low = down / steep;
      low_fall = shift / steep;
    }
    if (up > high * steep || !(up / steep < high)) return;
    high = up / steep;
    fall = shift / steep;
  }
  // Keeps p x + q y <= limit.
  void keep(double p, double q, double limit, double y) {
    const double bound = limit - q * y;
    if (p == 0) {
      if (bound < 0) high = -1;
    } else if (p < 0) {
      if (bound / p > low) {
        low = bound / p;
        low_fall = q / p;
      }
    } else if (bound / p < high) {
      high = bound / p;
      fall = q / p;
    }
  }
};

// Each cut adds at most one corner, and a demand makes four cuts.
constexpr std::size_t corners_of_stripes = 4 + 4 * most_demands_of_cell;

template <class AnyRegion>
void cut_stripes(std::span<const AxisDemand> demands, AnyRegion& region) {
  for (const AxisDemand& demand : demands) {
    region.cut(demand.entry_x, demand.entry_y, demand.limit);
    region.cut(-demand.entry_x, -demand.entry_y, demand.limit);
    region.cut(demand.exit_x, demand.exit_y, demand.limit);
    region.cut(-demand.exit_x, -demand.exit_y, demand.limit);
  }
}

// The range of x up to `most` for this y.
inline Interval entries(std::span<const AxisDemand> demands, double y, double most) {
  Interval left{.high = most};
  for (const AxisDemand& demand : demands) {
    left.meet(demand.entry_x, demand.entry_y, demand.limit, y);
    left.meet(demand.exit_x, demand.exit_y, demand.limit, y);
  }
  return left;
}
// The range of y up to `most` for this x. Demands without y are skipped. The x of the backward pass meets the demands
// but for rounding, and a demand that hardly depends on y would make a wide gap of that rounding.
inline Interval exits(std::span<const AxisDemand> demands, double x, double most) {
  Interval left{.high = most};
  for (const AxisDemand& demand : demands) {
    const double limit = demand.limit * (1 + rounding);
    if (demand.entry_y != 0) left.meet(demand.entry_y, demand.entry_x, limit, x);
    if (demand.exit_y != 0) left.meet(demand.exit_y, demand.exit_x, limit, x);
  }
  return left;
}

// The line in use of each curve.
using Lines = std::array<std::uint32_t, most_limited_axes>;

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

// Calls keep(p, q, limit), which stands for p x + q y <= limit, for each demand that the lines make.
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
  Interval at_most = entries(demands, exit_most, entry_most);
  for_each_demand(demands, falling, lines,
                  [&](double p, double q, double limit) { at_most.keep(p, q, limit, exit_most); });
  if (!at_most.is_empty() && !at_most.shrinks()) return at_most.high;

  SpeedRegion<corners_of_stripes + 4 * most_limited_axes> region(entry_most, exit_most);
  cut_stripes(demands, region);
  for_each_demand(demands, falling, lines, [&](double p, double q, double limit) { region.cut(p, q, limit); });
  return region.largest_x();
}

// The range of the exit that the lines allow for a given entry.
Interval exits_with(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, const Lines& lines,
                    double entry, Interval exits) {
  for_each_demand(demands, falling, lines,
                  [&](double p, double q, double limit) { exits.keep(q, p, limit * (1 + rounding), entry); });
  return exits;
}

// Each step of the iteration is one of Newton's method. Two are nearly always enough.
constexpr int most_rounds = 5;
// Relative, between two ways to compute a corner.
constexpr double corner_rounding = 1e-14;

// The largest x, if it lies below `y`, where the range of x is `above`. Two searches from line to line. First down to
// the largest y that leaves any x: where the binding lines of the two ends meet. If the upper end falls there, then to
// the summit between there and y = 0: where the binding lines of the upper end on both sides meet. A result below 0
// means that a search did not end: rounding may do that.
double corner_below(std::span<const AxisDemand> demands, double entry_most, double y, Interval above) {
  int rounds = most_rounds;
  for (; rounds > 0 && above.low > above.high * (1 + corner_rounding); --rounds) {
    const double closing = above.fall - above.low_fall;
    if (!(closing > 0 && closing < infinity)) return -1;
    y = std::max(0.0, y - (above.low - above.high) / closing);
    above = entries(demands, y, entry_most);
  }
  if (!above.shrinks()) return rounds > 0 ? above.high : -1;

  double below_y = 0;
  Interval below = entries(demands, below_y, entry_most);
  if (below.shrinks()) return below.high;
  for (; rounds > 0; --rounds) {
    const double rise = above.high + above.fall * (y - below_y) - below.high;
    const double middle_y = std::clamp(below_y + rise / (above.fall - below.fall), below_y, y);
    const double meeting = below.high - below.fall * (middle_y - below_y);
    const Interval middle = entries(demands, middle_y, entry_most);
    if (middle.high >= meeting * (1 - corner_rounding)) return middle.is_empty() ? -1 : middle.high;
    (middle.shrinks() ? above : below) = middle;
    (middle.shrinks() ? y : below_y) = middle_y;
  }
  return -1;
}

// A cell is halved for a gain of this share of its time.
constexpr double least_gain = 0.01;

}  // namespace

double largest_entry(std::span<const AxisDemand> demands, double entry_most, double exit_most) {
  // Mostly the best point is that of the hardest braking, on y = Y. The upper end of x is concave in y, so it is the
  // maximum where it does not fall there.
  const Interval at_most = entries(demands, exit_most, entry_most);
  if (!at_most.is_empty() && !at_most.shrinks()) return at_most.high;
  const double corner = corner_below(demands, entry_most, exit_most, at_most);
  if (corner >= 0) return corner;

  SpeedRegion<corners_of_stripes> region(entry_most, exit_most);
  cut_stripes(demands, region);
  return region.largest_x();
}

double largest_exit(std::span<const AxisDemand> demands, double entry, double exit_most) {
  const Interval left = exits(demands, entry, exit_most);
  const double at_most = std::max(0.0, left.high);
  if (left.low <= left.high + rounding * entry) return at_most;
  // The entry is too fast. At the edge of what is possible rounding may leave nothing; the slower exit is then right.
  const double least = least_exit(demands, entry);
  return least > left.high + rounding * entry ? least : at_most;
}

double least_exit(std::span<const AxisDemand> demands, double entry) {
  const Interval left = exits(demands, entry, infinity);
  return std::max(0.0, std::min(left.low, left.high));
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
  const Interval all = exits(demands, entry, top);
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

  // Braking as hard as possible, or harder. A top that was lowered may not be reached at once.
  const Interval any = exits(demands, entry, infinity);
  const Interval fresh = exits_with(demands, falling, lines_at(falling, entry, exit_most), entry, any);
  const Interval kept = exits_with(demands, falling, kept_lines(falling), entry, any);
  const bool is_fresh_better = fresh.low <= fresh.high && !(kept.low <= kept.high && kept.low < fresh.low);
  Interval better = is_fresh_better ? fresh : kept;
  const bool has_way = better.low <= better.high;
  const bool above_top = entry > top;
  // Above a lowered top, at the edge of what is possible, the lines of this speed are right. Rounding may leave
  // nothing; the slower exit is then right.
  if (!has_way && above_top) better = exits_with(demands, falling, lines_at(falling, entry, entry), entry, any);
  const double least = std::min(better.low, better.high);
  const bool too_fast = least > exit_most + rounding * entry && (has_way || above_top);
  return too_fast ? least : std::max(0.0, std::min(exit_most, better.high));
}

double least_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry) {
  if (falling.empty()) return least_exit(demands, entry);
  const Interval any = exits(demands, entry, infinity);
  const std::array<Lines, 3> choices = {lines_at(falling, entry, 0), kept_lines(falling),
                                        lines_at(falling, entry, entry)};
  double least = infinity;
  for (const Lines& lines : choices) {
    const Interval left = exits_with(demands, falling, lines, entry, any);
    if (left.low <= left.high) least = std::min(least, left.low);
  }
  if (least < infinity) return std::max(0.0, least);
  // At the edge of what is possible rounding may leave nothing. What does not depend on the exit is then met but for
  // rounding, and the slower exit is right.
  Interval edge = any;
  for_each_demand(demands, falling, choices.back(), [&](double p, double q, double limit) {
    if (q != 0) edge.keep(q, p, limit * (1 + rounding), entry);
  });
  return std::max(0.0, std::min(edge.low, edge.high));
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

Ride hardest_braking(const Cell& cell, std::span<const AxisDemand> demands, std::span<const FallingDemand> falling,
                     double entry) {
  const double deceleration =
      cell.straight ? cell.acceleration : sure_deceleration(demands, falling, cell.length, entry);
  if (deceleration > 0 && entry < 2 * deceleration * cell.length) {
    const double way = entry / (2 * deceleration);
    return {way + cell.smallest_rest < cell.length ? way : cell.length, 0};
  }
  const double least =
      cell.straight ? std::max(0.0, entry - 2 * cell.acceleration * cell.length) : least_exit(demands, falling, entry);
  return {cell.length, least};
}

bool is_too_long(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, const CellRide& ride) {
  const double mean = (ride.entry + ride.exit) / 2;
  const double higher = std::max(ride.entry, ride.exit);
  const double strength = sure_deceleration(demands, falling, ride.length, higher);
  const double peak = std::min(ride.top, mean + strength * ride.length);
  if (!(strength > 0) || peak < higher) return false;
  const double top = std::sqrt(peak);
  const double ends = std::sqrt(ride.entry) + std::sqrt(ride.exit);
  const double ramps = (peak - mean) / strength;
  const double best = (2 * top - ends) / strength + (ride.length - ramps) / top;
  return 2 * ride.length > (1 + least_gain) * best * ends;
}

}  // namespace passo
