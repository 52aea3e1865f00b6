#include "soonest_stop.hpp"

#include <cmath>
#include <cstddef>

#include "jerk_window.hpp"

namespace passo {
namespace {

// The first distance is that of braking on a straight line. Each further one is longer by this factor, until a stop is
// found.
constexpr double longer = 1.25;
constexpr int most_ways = 12;
// The shortest distance is then found to within this factor.
constexpr double near_enough = 1.06;
// A stop passes some 20 to 200 cells.
constexpr std::size_t most_cells_of_stop = 2000;
constexpr PlanEffort little{.rounds = 3, .attempts = 2};

std::optional<SpeedChange> fastest_to_rest_after(double way, PathAhead& path, const PathState& from,
                                                 const SpeedChange::Request& request) {
  JerkWindow window({.axes = request.axes,
                     .path = path,
                     .feeds = request.feeds,
                     .stops = request.stops,
                     .most_queued = most_cells_of_stop},
                    little);
  window.begin_at(from);
  if (!window.can_rest_after(way)) return std::nullopt;
  std::vector<SpeedChange::Piece> pieces;
  PathState state = from;
  PlannedMove move;
  for (std::size_t i = 0; window.peek(i, state.segment, move); ++i) {
    if (move.phase_count == 0) return std::nullopt;
    for (const Phase& phase : move) pieces.push_back({.segment = state.segment, .phase = phase});
    const PathState after = PathState::behind(move, state.segment);
    pieces.back().ends_segment = after.segment > state.segment;
    state = after;
  }
  return SpeedChange::to_rest(pieces, state, path, request);
}

}  // namespace

std::optional<SpeedChange> soonest_stop(PathAhead& path, const PathState& from, const SpeedChange::Request& to_rest) {
  SpeedChange::Request request = to_rest;
  request.planned = true;
  std::optional<SpeedChange> soonest;
  const auto try_way = [&](double way) {
    std::optional<SpeedChange> stop = fastest_to_rest_after(way, path, from, request);
    if (!stop) return false;
    if (!soonest || stop->duration_from(0) < soonest->duration_from(0)) soonest = std::move(stop);
    return true;
  };
  double high = from.speed / 2 * SpeedChange::shortest_stop(path, from, request).value();
  int ways = 1;
  while (!try_way(high) && ways++ < most_ways) high *= longer;
  // A shorter distance takes less time, down to where the limits allow no stop.
  for (double low = high / longer; soonest && high > low * near_enough;) {
    const double middle = std::sqrt(low * high);
    (try_way(middle) ? high : low) = middle;
  }
  return soonest;
}

}  // namespace passo
