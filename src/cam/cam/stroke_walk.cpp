#include "stroke_walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flat_vector.hpp"

#include "passo/cam/route.hpp"

namespace passo {
namespace {

class StrokeWalker {
 public:
  StrokeWalker(std::vector<CutterStroke> strokes, std::size_t nodes)
      : strokes_(std::move(strokes)), is_cut_(strokes_.size()), at_node_(nodes) {
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      at_node_[strokes_[i].from].push_back(i);
      at_node_[strokes_[i].to].push_back(i);
    }
  }

  std::vector<MillRun> walk(DrawnPoint park);

 private:
  std::size_t start_of_all_at(std::size_t first);
  std::size_t next_stroke(std::size_t node, const MillRun& run) const;
  void cut_from(std::size_t start, std::vector<MillRun>& runs);

  std::vector<CutterStroke> strokes_;
  std::vector<bool> is_cut_;
  std::vector<std::vector<std::size_t>> at_node_;  // strokes
  std::vector<bool> is_seen_;                      // nodes
};

// Of all that hangs together with this node, a node at which one stroke ends. Without such a node this one.
std::size_t StrokeWalker::start_of_all_at(std::size_t first) {
  std::vector<std::size_t> together = {first};
  is_seen_[first] = true;
  std::size_t start = first;
  for (std::size_t k = 0; k < together.size(); ++k) {
    if (at_node_[together[k]].size() == 1 && at_node_[start].size() != 1) start = together[k];
    for (const std::size_t i : at_node_[together[k]]) {
      for (const std::size_t node : {strokes_[i].from, strokes_[i].to}) {
        if (!is_seen_[node]) together.push_back(node);
        is_seen_[node] = true;
      }
    }
  }
  return start;
}

std::vector<MillRun> StrokeWalker::walk(DrawnPoint park) {
  std::vector<std::size_t> starts;
  std::vector<DrawnPoint> places;
  is_seen_.assign(at_node_.size(), false);
  for (std::size_t first = 0; first < at_node_.size(); ++first) {
    if (is_seen_[first] || at_node_[first].empty()) continue;
    const std::size_t start = start_of_all_at(first);
    const CutterStroke& stroke = strokes_[at_node_[start].front()];
    starts.push_back(start);
    places.push_back(stroke.from == start ? stroke.points.front().at : stroke.points.back().at);
  }
  constexpr std::uint64_t steps = 2'000'000;
  std::vector<MillRun> runs;
  for (const std::uint32_t index : shorten_route(places, park, park, steps)) cut_from(starts[index], runs);
  return runs;
}

// The stroke at the node that goes on most nearly straight, and is not cut yet. Beyond the last: there is none.
std::size_t StrokeWalker::next_stroke(std::size_t node, const MillRun& run) const {
  std::size_t best = strokes_.size();
  double best_turn = 10;
  for (const std::size_t i : at_node_[node]) {
    const CutterStroke& stroke = strokes_[i];
    if (is_cut_[i]) continue;
    double turn = 5;
    if (run.size() > 1) {
      const bool is_ahead = stroke.from == node;
      const FlatVector in = from_to(run[run.size() - 2].at, run.back().at);
      const FlatVector out =
          from_to(run.back().at, is_ahead ? stroke.points[1].at : stroke.points[stroke.points.size() - 2].at);
      turn = std::abs(std::remainder(std::atan2(out.y, out.x) - std::atan2(in.y, in.x), 2 * std::numbers::pi));
    }
    if (turn < best_turn) {
      best_turn = turn;
      best = i;
    }
  }
  return best;
}

void StrokeWalker::cut_from(std::size_t start, std::vector<MillRun>& runs) {
  std::vector<std::size_t> passed = {start};
  MillRun run;
  while (!passed.empty()) {
    const std::size_t next = next_stroke(passed.back(), run);
    if (next == strokes_.size()) {
      // The end of a branch: on at the last place where one is left.
      if (run.size() > 1) runs.push_back(std::move(run));
      run.clear();
      passed.pop_back();
      continue;
    }
    is_cut_[next] = true;
    CutterStroke& stroke = strokes_[next];
    const bool is_ahead = stroke.from == passed.back();
    if (!is_ahead) std::ranges::reverse(stroke.points);
    for (const MillPoint& point : stroke.points) {
      if (run.empty() || run.back().at != point.at || run.back().z != point.z) run.push_back(point);
    }
    passed.push_back(is_ahead ? stroke.to : stroke.from);
  }
}

}  // namespace

std::vector<MillRun> walk_strokes(std::vector<CutterStroke> strokes, std::size_t nodes, DrawnPoint park) {
  return StrokeWalker(std::move(strokes), nodes).walk(park);
}

}  // namespace passo
