#include "emergency_brake.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "rest.hpp"
#include "speed_profile.hpp"

namespace passo {
namespace {

// The motion before keeps its limits at the ends of other cells. What cells take off the limits for what happens
// between their ends may therefore be missing here: some thousandths. A way that asks for more than this share above
// the limits is none.
constexpr double most_excess = 0.01;
// Nor is a way that goes faster than the feed, or rises above what the axes' velocities allow: what cells take off the
// limits may let the speed only rise. The motion before is not that careful.
constexpr double most_too_fast = 4e-4;

}  // namespace

EmergencyBrake::EmergencyBrake(const MotionLimits& limits)
    : cutter_(limits), demands_(cutter_.most_demands()), falling_(cutter_.most_falling()) {}

bool EmergencyBrake::plan(PathAhead& path, const PathState& from, const FeedFactors& feeds,
                          std::vector<PlannedMove>& plan) {
  plan.clear();
  double s = from.s;
  double speed_squared = from.speed * from.speed;
  for (std::uint64_t number = from.segment; speed_squared > 0; ++number, s = 0) {
    const Segment* segment = path.at(number);
    const bool ends = segment == nullptr || (number > from.segment && rests_between(*path.at(number - 1), *segment));
    if (!ends) speed_squared = brake_on(*segment, s, speed_squared, feeds.speed_on(*segment), plan);
    if (!ends && speed_squared >= 0) continue;
    plan.clear();
    return false;
  }
  return true;
}

double EmergencyBrake::brake_on(const Segment& segment, double from, double speed_squared, double feed,
                                std::vector<PlannedMove>& plan) {
  const double most = std::pow(feed * (1 + most_too_fast), 2);
  bool begins = true;
  for (cutter_.begin(segment, speed_squared, from); speed_squared > 0 && !cutter_.at_end(); begins = false) {
    cutter_.next({cell_, demands_.data(), falling_.data()});
    const Ride ride = hardest_braking(cell_, std::span(demands_).first(cell_.demand_count),
                                      std::span(falling_).first(cell_.falling_count), speed_squared);
    if (!allows(speed_squared, ride) || std::max(speed_squared, ride.exit) > most) return -1;
    if (begins || plan.back().phase_count == PlannedMove::most_phases) plan.emplace_back().begin_on(segment);
    add_phase(cell_.start, ride.way, speed_squared, ride.exit, plan.back());
    plan.back().to = Mm(ride.way < cell_.length ? cell_.start + ride.way : cell_.end);
    speed_squared = ride.exit;
  }
  return speed_squared;
}

bool EmergencyBrake::allows(double entry, const Ride& ride) const {
  constexpr double excess = 1 + most_excess;
  constexpr double too_fast = 1 + most_too_fast;
  if (ride.exit > entry && ride.exit > cell_.top_squared * too_fast * too_fast) return false;
  if (entry > cell_.top_squared * excess * excess) return false;
  if (ride.way < cell_.length) return true;
  return std::ranges::all_of(std::span(demands_).first(cell_.demand_count), [&](const AxisDemand& demand) {
    const double most = demand.limit * excess;
    return std::abs(demand.entry_x * entry + demand.entry_y * ride.exit) <= most &&
           std::abs(demand.exit_x * entry + demand.exit_y * ride.exit) <= most;
  });
}

}  // namespace passo
