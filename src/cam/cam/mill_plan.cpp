#include "passo/cam/mill_plan.hpp"

#include <algorithm>
#include <cmath>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

constexpr Nanometres above_floor{200'000};  // where the feed into a floor begins
constexpr Nanometres link_lift{200'000};
constexpr double link_slope = 1e6;  // nm: the way on which a link rises, and falls

}  // namespace

void enter_above(MillRun& run, DrawnPoint at, Nanometres floor) {
  const Nanometres low = floor + above_floor;
  if (low.count >= 0) return;
  run.push_back({at, 0, {}, MillPace::rapid});
  run.push_back({at, 0, low});
}

void link_to(MillRun& run, DrawnPoint to) {
  const MillPoint from = run.back();
  const double length = distance_nm(from.at, to);
  if (length <= 0) return;
  run.back().bulge = 0;
  run.back().pace = MillPace::link;
  if (length > link_slope) {
    const double slope = std::min(link_slope, length / 4);
    const Nanometres high = from.z + link_lift;
    for (const double along : {slope, length - slope})
      run.push_back({point_along(from.at, to, 0, along / length), 0, high, MillPace::link});
  }
  run.push_back({to, 0, from.z});
}

namespace {

MillLengths lengths_between(const MillTool& tool, DrawnPoint at, std::optional<DrawnPoint> to) {
  MillLengths lengths;
  for (const MillRun& run : tool.runs) {
    ++lengths.runs;
    lengths.rapids_nm += distance_nm(at, run.front().at);
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      if (run[i].pace == MillPace::rapid) continue;
      const auto down = static_cast<double>(run[i + 1].z.count - run[i].z.count);
      const double way = std::hypot(way_nm(run[i].at, run[i + 1].at, run[i].bulge), down);
      (run[i].pace == MillPace::link ? lengths.links_nm : lengths.milled_nm) += way;
    }
    at = run.back().at;
  }
  if (to) lengths.rapids_nm += distance_nm(at, *to);
  return lengths;
}

}  // namespace

MillLengths lengths_of(const MillTool& tool, DrawnPoint park) {
  return lengths_between(tool, park, park);
}

std::vector<MillLengths> lengths_of(const MillPlan& plan, DrawnPoint park, const RouteLink& link) {
  std::vector<MillLengths> all;
  DrawnPoint at = link.from(park);
  for (const MillTool& tool : plan.tools) {
    const std::optional<DrawnPoint> to = link.to(park, all.size() + 1 == plan.tools.size());
    all.push_back(lengths_between(tool, at, to));
    at = to.value_or(tool.runs.empty() ? at : tool.runs.back().back().at);
  }
  return all;
}

DrawnPoint end_of(const MillPlan& plan, DrawnPoint park, const RouteLink& link) {
  if (plan.tools.empty()) return link.from(park);
  const std::vector<MillRun>& runs = plan.tools.back().runs;
  return link.changes_in_place && !runs.empty() ? runs.back().back().at : park;
}

std::vector<DrawnPoint> chords_of(const MillRun& run, Nanometres tolerance) {
  std::vector<DrawnPoint> points = {run.front().at};
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    const DrawnPoint from = run[i].at;
    const DrawnPoint to = run[i + 1].at;
    const std::size_t pieces = chords_on(from, to, run[i].bulge, tolerance);
    for (std::size_t k = 1; k < pieces; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(pieces);
      points.push_back(point_along(from, to, run[i].bulge, share));
    }
    points.push_back(to);
  }
  return points;
}

}  // namespace passo
