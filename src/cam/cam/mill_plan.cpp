#include "passo/cam/mill_plan.hpp"

#include <algorithm>
#include <cmath>

#include "passo/cam/bulge.hpp"

namespace passo {

MillLengths lengths_of(const MillTool& tool, DrawnPoint park) {
  MillLengths lengths;
  DrawnPoint at = park;
  for (const MillRun& run : tool.runs) {
    ++lengths.runs;
    lengths.rapids_nm += distance_nm(at, run.front().at);
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const auto down = static_cast<double>(run[i + 1].z.count - run[i].z.count);
      lengths.milled_nm += std::hypot(way_nm(run[i].at, run[i + 1].at, run[i].bulge), down);
    }
    at = run.back().at;
  }
  lengths.rapids_nm += distance_nm(at, park);
  return lengths;
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
