#include "finish_pass.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "flat_vector.hpp"

namespace passo {
namespace {

struct LeadPlace {
  double along = 0;
  DrawnPoint from = {};  // where the arc in begins
  DrawnPoint to = {};    // where the arc out ends
  bool has_arcs = false;
};

double quarter_of(bool climb) {
  return std::tan(std::numbers::pi / 8) * (climb ? 1 : -1);
}

// The cleared side lies to the left where the cutter climbs.
std::optional<LeadPlace> arcs_at(const ClosedToolpath& track, double along, double radius, const FinishPass& pass) {
  const DrawnPoint start = track.at(along);
  const double direction = track.direction(along);
  const FlatVector ahead{std::cos(direction) * radius, std::sin(direction) * radius};
  const double side = pass.climb ? 1 : -1;
  const FlatVector aside{-ahead.y * side, ahead.x * side};
  const DrawnPoint from = shifted(start, {aside.x - ahead.x, aside.y - ahead.y});
  const DrawnPoint to = shifted(start, {aside.x + ahead.x, aside.y + ahead.y});
  const double quarter = quarter_of(pass.climb);
  const bool fits =
      pass.is_cut(from) && pass.is_cut(to) && pass.is_clear(from, start, quarter) && pass.is_clear(start, to, quarter);
  if (!fits) return std::nullopt;
  return LeadPlace{along, from, to, true};
}

LeadPlace place_of(const ClosedToolpath& track, const FinishPass& pass) {
  constexpr int places = 32;
  constexpr int halvings = 5;
  double radius = pass.lead_nm;
  std::optional<double> free;  // of tabs
  for (int k = 0; k < halvings && radius > 0; ++k, radius /= 2) {
    for (int i = 0; i < places; ++i) {
      const double along = track.length() * i / places;
      if (track.keeps(along - 2 * radius, along + 2 * radius)) continue;
      if (!free) free = along;
      if (const std::optional<LeadPlace> place = arcs_at(track, along, radius, pass)) return *place;
    }
  }
  return {free.value_or(0), {}, {}, false};
}

}  // namespace

MillRun finish_run(const ClosedToolpath& track, const FinishPass& pass) {
  const LeadPlace place = place_of(track, pass);
  const double quarter = quarter_of(pass.climb);
  MillRun run;
  if (place.has_arcs) {
    enter_above(run, place.from, pass.floor);
    run.push_back({place.from, quarter, pass.depth});
  }
  const double laps = 1.0 + pass.spring_passes;
  track.append(run, place.along, place.along + laps * track.length(), pass.depth, pass.depth);
  if (place.has_arcs) {
    run.back().bulge = quarter;
    run.push_back({place.to, 0, pass.depth});
  }
  mark_finish(run, 0);
  return run;
}

void mark_finish(MillRun& run, std::size_t from) {
  for (std::size_t i = from; i < run.size(); ++i) {
    if (run[i].pace == MillPace::cut) run[i].pace = MillPace::finish;
  }
}

}  // namespace passo
