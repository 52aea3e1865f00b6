#include "soonest_stop.hpp"

#include <cstddef>

#include "jerk_window.hpp"

namespace passo {
namespace {

// The first way is that of braking on a straight line. Each further one is so much longer.
constexpr double longer = 1.25;
constexpr int most_ways = 12;
constexpr double worth_of_longer = 0.98;  // of the time: a stop after a longer way is worth it
// A stop passes some 20 to 200 cells.
constexpr std::size_t most_cells_of_stop = 2000;
constexpr PlanEffort little{.rounds = 3, .attempts = 2};

std::optional<SpeedChange> fastest_to_rest_after(double way, PathAhead& path, const PathState& from,
                                                 const SpeedChange::Request& request) {
  JerkWindow window({.axes = request.axes, .path = path, .feeds = request.feeds, .most_queued = most_cells_of_stop},
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

std::optional<SpeedChange> soonest_stop(PathAhead& path, const PathState& from, const std::vector<LimitedAxis>& axes,
                                        const FeedFactors& feeds) {
  double way = from.speed / 2 * SpeedChange::shortest_stop(path, from, axes).value();
  std::optional<SpeedChange> soonest;
  for (int i = 0; i < most_ways; ++i, way *= longer) {
    std::optional<SpeedChange> stop =
        fastest_to_rest_after(way, path, from, {.axes = axes, .feeds = feeds, .exit = 0, .planned = true});
    if (soonest && !(stop && stop->duration_from(0) < soonest->duration_from(0) * worth_of_longer)) break;
    soonest = std::move(stop);
  }
  return soonest;
}

}  // namespace passo
