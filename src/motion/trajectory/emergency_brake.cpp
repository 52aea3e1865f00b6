#include "emergency_brake.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "speed_profile.hpp"

namespace passo {
namespace {

// The motion before uses more of the limits than a cell may: the cell takes something off for what happens between its
// ends. In halves a cell takes off a quarter.
constexpr int most_halvings = 5;
// So much above the limits and the feed is what the motion before may use by its own rounding.
constexpr double most_excess = 4e-4;

}  // namespace

EmergencyBrake::EmergencyBrake(const MotionLimits& limits)
    : cutter_(limits), demands_(cutter_.most_demands()), falling_(cutter_.most_falling()) {}

bool EmergencyBrake::plan(PathAhead& path, const PathState& from, const FeedFactors& feeds,
                          std::vector<PlannedMove>& plan) {
  plan.clear();
  double s = from.s;
  double speed_squared = from.speed * from.speed;
  std::uint64_t number = from.segment;
  for (const Segment* segment = path.at(number); segment != nullptr; segment = path.after(number++), s = 0) {
    speed_squared = brake_on(*segment, s, speed_squared, feeds.speed_on(*segment), plan);
    if (speed_squared == 0) return true;
    if (speed_squared < 0) break;
  }
  plan.clear();
  return false;
}

double EmergencyBrake::brake_on(const Segment& segment, double from, double speed_squared, double feed,
                                std::vector<PlannedMove>& plan) {
  most_squared_ = std::pow(feed * (1 + most_excess), 2);
  for (cutter_.begin(segment, speed_squared, from); speed_squared > 0 && !cutter_.at_end();) {
    cutter_.next(place());
    speed_squared = brake_in_cell(segment, speed_squared, most_halvings, plan);
  }
  return speed_squared;
}

double EmergencyBrake::brake_in_cell(const Segment& segment, double entry, int halvings,
                                     std::vector<PlannedMove>& plan) {
  const Ride ride = hardest_braking(cell_, std::span(demands_).first(cell_.demand_count),
                                    std::span(falling_).first(cell_.falling_count), entry);
  if (allows(entry, ride)) {
    add_ride(segment, cell_, entry, ride, plan);
    return ride.exit;
  }
  if (cell_.straight || halvings == 0) return -1;
  const double end = cell_.end;
  const double middle = cell_.start + cell_.length / 2;
  cutter_.cut(segment, cell_.start, middle, false, place());
  const double halfway = brake_in_cell(segment, entry, halvings - 1, plan);
  if (!(halfway > 0)) return halfway;
  cutter_.cut(segment, middle, end, false, place());
  return brake_in_cell(segment, halfway, halvings - 1, plan);
}

bool EmergencyBrake::allows(double entry, const Ride& ride) const {
  constexpr double excess = 1 + most_excess;
  const double higher = std::max(entry, ride.exit);
  if (higher > most_squared_ || higher > cell_.top_squared * excess * excess) return false;
  if (ride.way < cell_.length) return true;
  return std::ranges::all_of(std::span(demands_).first(cell_.demand_count), [&](const AxisDemand& demand) {
    const double most = demand.limit * excess;
    return std::abs(demand.entry_x * entry + demand.entry_y * ride.exit) <= most &&
           std::abs(demand.exit_x * entry + demand.exit_y * ride.exit) <= most;
  });
}

}  // namespace passo
