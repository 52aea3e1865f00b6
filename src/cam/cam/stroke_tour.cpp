#include "stroke_tour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "flat_vector.hpp"

#include "passo/cam/bulge.hpp"
#include "passo/cam/route.hpp"

namespace passo {
namespace {

constexpr std::size_t no_stroke = static_cast<std::size_t>(-1);
constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t most_free_ends = 2;  // the two ends of the first run cost nothing

// A stroke, a return along it, or a lift from one node to another.
struct TourStep {
  std::size_t from = 0;
  std::size_t to = 0;
  std::size_t stroke = no_stroke;  // none: a lift
};

// The least cost of a subtree, depending on whether the stroke to the parent is traversed twice, and on the number of
// free ends that are used.
using SubtreeCosts = std::array<std::array<double, most_free_ends + 1>, 2>;
constexpr SubtreeCosts no_costs = {{{never, never, never}, {never, never, never}}};

struct SubtreeChoice {
  std::size_t twice = 0;  // whether the stroke to a child is gone twice
  std::size_t ends = 0;   // free ends in the child's subtree
};
using SubtreeChoices = std::array<std::array<SubtreeChoice, most_free_ends + 1>, 2>;

// Chooses the strokes that are traversed twice, and the nodes at which runs begin and end.
class ReturnChooser {
 public:
  ReturnChooser(const std::vector<CutterStroke>& strokes, const std::vector<double>& lengths,
                const std::vector<std::vector<std::size_t>>& at_node, double lift)
      : strokes_(strokes), lengths_(lengths), at_node_(at_node), lift_(lift), nodes_(at_node.size()) {}

  struct Choice {
    std::vector<bool> is_twice;                    // strokes
    std::vector<bool> is_end;                      // nodes
    std::vector<std::vector<std::size_t>> groups;  // the nodes of all that hangs together, from a root outwards
  };
  Choice choose();

 private:
  struct TreeNode {
    std::size_t parent = no_stroke;  // stroke to the parent
    SubtreeCosts costs = no_costs;
    SubtreeChoices choices = {};  // of this node as a child, by the state of the parent after it
    std::array<std::array<std::uint8_t, most_free_ends + 1>, 2> ends = {};  // 0: no end, 1: an end, 2: a free one
    bool is_seen = false;
  };

  void find_tree();
  void group_from(std::size_t root);
  void find_costs(std::size_t node);
  void decide(const std::vector<std::size_t>& group);
  std::size_t other(std::size_t stroke, std::size_t node) const {
    return strokes_[stroke].from == node ? strokes_[stroke].to : strokes_[stroke].from;
  }
  template <class Visit>
  void each_child(std::size_t node, Visit visit) const {
    for (const std::size_t i : at_node_[node]) {
      if (is_of_tree_[i] && i != nodes_[node].parent) visit(i, other(i, node));
    }
  }

  const std::vector<CutterStroke>& strokes_;
  const std::vector<double>& lengths_;
  const std::vector<std::vector<std::size_t>>& at_node_;
  double lift_;
  std::vector<bool> is_of_tree_;
  std::vector<TreeNode> nodes_;
  Choice choice_;
};

// The shortest strokes that connect all nodes (J. B. Kruskal).
void ReturnChooser::find_tree() {
  std::vector<std::size_t> order(strokes_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return lengths_[i]; });
  std::vector<std::size_t> leader(at_node_.size());
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  const auto leader_of = [&](std::size_t node) {
    while (leader[node] != node) {
      leader[node] = leader[leader[node]];
      node = leader[node];
    }
    return node;
  };
  is_of_tree_.assign(strokes_.size(), false);
  for (const std::size_t i : order) {
    const std::size_t a = leader_of(strokes_[i].from);
    const std::size_t b = leader_of(strokes_[i].to);
    if (a == b) continue;
    leader[a] = b;
    is_of_tree_[i] = true;
  }
}

void ReturnChooser::group_from(std::size_t root) {
  std::vector<std::size_t> group = {root};
  nodes_[root].is_seen = true;
  for (std::size_t k = 0; k < group.size(); ++k) {
    each_child(group[k], [&](std::size_t stroke, std::size_t child) {
      nodes_[child].parent = stroke;
      nodes_[child].is_seen = true;
      group.push_back(child);
    });
  }
  choice_.groups.push_back(std::move(group));
}

// From the children's costs. The number of strokes at a node, including returns and its own free end, is even.
void ReturnChooser::find_costs(std::size_t node) {
  SubtreeCosts sum = no_costs;  // by whether the number of strokes so far is odd
  sum[at_node_[node].size() % 2][0] = 0;
  each_child(node, [&](std::size_t stroke, std::size_t child) {
    SubtreeCosts next = no_costs;
    for (std::size_t odd = 0; odd < 2; ++odd) {
      for (std::size_t ends = 0; ends <= most_free_ends; ++ends) {
        for (std::size_t twice = 0; twice < 2; ++twice) {
          for (std::size_t of_child = 0; ends + of_child <= most_free_ends; ++of_child) {
            const double cost =
                sum[odd][ends] + nodes_[child].costs[twice][of_child] + static_cast<double>(twice) * lengths_[stroke];
            double& best = next[odd ^ twice][ends + of_child];
            if (cost >= best) continue;
            best = cost;
            nodes_[child].choices[odd ^ twice][ends + of_child] = {twice, of_child};
          }
        }
      }
    }
    sum = next;
  });
  TreeNode& here = nodes_[node];
  for (std::size_t up = 0; up < 2; ++up) {
    for (std::size_t ends = 0; ends <= most_free_ends; ++ends) {
      const std::array<double, 3> costs = {sum[up][ends], sum[up ^ 1U][ends] + lift_ / 2,
                                           ends > 0 ? sum[up ^ 1U][ends - 1] : never};
      const auto least = std::ranges::min_element(costs);
      here.costs[up][ends] = *least;
      here.ends[up][ends] = static_cast<std::uint8_t>(least - costs.begin());
    }
  }
}

// From the root to the leaves.
void ReturnChooser::decide(const std::vector<std::size_t>& group) {
  struct State {
    std::size_t twice = 0;
    std::size_t ends = 0;
  };
  std::vector<State> states(group.size());
  std::vector<std::size_t> places;  // of the children in the group, which has them in this order
  const auto& at_root = nodes_[group.front()].costs[0];
  states[0].ends = static_cast<std::size_t>(std::ranges::min_element(at_root) - at_root.begin());
  std::size_t next_place = 1;
  for (std::size_t k = 0; k < group.size(); ++k) {
    const std::size_t node = group[k];
    const std::uint8_t end = nodes_[node].ends[states[k].twice][states[k].ends];
    choice_.is_end[node] = end > 0;
    State after{states[k].twice ^ (end > 0 ? 1U : 0U), states[k].ends - (end == 2 ? 1 : 0)};
    std::vector<std::pair<std::size_t, std::size_t>> children;
    each_child(node, [&](std::size_t stroke, std::size_t child) { children.emplace_back(stroke, child); });
    for (std::size_t i = children.size(); i-- > 0;) {
      const SubtreeChoice chosen = nodes_[children[i].second].choices[after.twice][after.ends];
      choice_.is_twice[children[i].first] = chosen.twice == 1;
      states[next_place + i] = {chosen.twice, chosen.ends};
      after = {after.twice ^ chosen.twice, after.ends - chosen.ends};
    }
    next_place += children.size();
  }
}

ReturnChooser::Choice ReturnChooser::choose() {
  choice_.is_twice.assign(strokes_.size(), false);
  choice_.is_end.assign(at_node_.size(), false);
  find_tree();
  for (std::size_t node = 0; node < at_node_.size(); ++node) {
    if (nodes_[node].is_seen || at_node_[node].empty()) continue;
    group_from(node);
    const std::vector<std::size_t>& group = choice_.groups.back();
    for (std::size_t k = group.size(); k-- > 0;) find_costs(group[k]);
    decide(group);
  }
  return std::move(choice_);
}

class StrokeTourist {
 public:
  StrokeTourist(const std::vector<CutterStroke>& strokes, std::size_t nodes, const StrokeTour& tour)
      : strokes_(strokes), tour_(tour), at_node_(nodes), steps_at_(nodes), is_cut_(strokes.size()) {
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      at_node_[strokes_[i].from].push_back(i);
      at_node_[strokes_[i].to].push_back(i);
    }
  }

  std::vector<MillRun> runs();

 private:
  using Path = std::vector<TourStep>;

  void add_step(const TourStep& step) {
    steps_at_[step.from].push_back(steps_.size());
    steps_at_[step.to].push_back(steps_.size());
    steps_.push_back(step);
  }
  std::size_t add_lifts(const std::vector<std::size_t>& group, const std::vector<bool>& is_end);
  std::size_t next_step(std::size_t node, const TourStep* before) const;
  Path path_from(std::size_t start);
  void order(std::vector<Path>& paths) const;
  void cut(const Path& path, std::vector<MillRun>& runs);
  void cut_run(const Path& path, std::vector<MillRun>& runs);
  DrawnPoint place(const TourStep& step, std::size_t node) const {
    const CutterStroke& stroke = strokes_[step.stroke];
    return stroke.from == node ? stroke.points.front().at : stroke.points.back().at;
  }
  FlatVector direction(const TourStep& step, bool at_end) const;

  const std::vector<CutterStroke>& strokes_;
  const StrokeTour& tour_;
  std::vector<std::vector<std::size_t>> at_node_;  // strokes
  std::vector<TourStep> steps_;
  std::vector<std::vector<std::size_t>> steps_at_;  // by node
  std::vector<bool> is_gone_;                       // steps
  std::vector<bool> is_cut_;                        // strokes
};

// Returns the node at which the tour of the group begins.
std::size_t StrokeTourist::add_lifts(const std::vector<std::size_t>& group, const std::vector<bool>& is_end) {
  std::vector<std::size_t> ends;
  std::ranges::copy_if(group, std::back_inserter(ends), [&](std::size_t node) { return is_end[node]; });
  if (ends.empty()) return group.front();
  const auto place_of = [&](std::size_t node) {
    const CutterStroke& stroke = strokes_[at_node_[node].front()];
    return stroke.from == node ? stroke.points.front().at : stroke.points.back().at;
  };
  // From each end to a near one that is still free; the last one ends the tour. Neighbours in this order are near each
  // other.
  constexpr std::ptrdiff_t most_tried = 64;
  for (std::size_t i = 1; i + 2 < ends.size(); i += 2) {
    const auto first = ends.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto last = std::min(first + most_tried, ends.end());
    const auto to = std::min_element(first, last, [&](std::size_t a, std::size_t b) {
      return distance_nm(place_of(a), place_of(ends[i])) < distance_nm(place_of(b), place_of(ends[i]));
    });
    std::iter_swap(first, to);
    add_step({ends[i], *first, no_stroke});
  }
  return ends.front();
}

// The direction in which a step begins, or ends.
FlatVector StrokeTourist::direction(const TourStep& step, bool at_end) const {
  const MillRun& points = strokes_[step.stroke].points;
  const bool is_ahead = strokes_[step.stroke].from == step.from;
  const bool is_first = is_ahead != at_end;
  const std::size_t i = is_first ? 0 : points.size() - 2;
  FlatVector along = from_to(points[i].at, points[i + 1].at);
  // At the ends of an arc its tangent leaves the chord by half of its sweep.
  const double lean = sweep_of(points[i].bulge) / 2 * (is_first ? -1 : 1);
  along = {along.x * std::cos(lean) - along.y * std::sin(lean), along.x * std::sin(lean) + along.y * std::cos(lean)};
  return is_ahead ? along : FlatVector{-along.x, -along.y};
}

// First the uncut strokes, the straightest one first; then the returns, then the lifts.
std::size_t StrokeTourist::next_step(std::size_t node, const TourStep* before) const {
  std::size_t best = steps_.size();
  double best_rank = never;
  for (const std::size_t i : steps_at_[node]) {
    if (is_gone_[i]) continue;
    TourStep step = steps_[i];
    if (step.from != node) std::swap(step.from, step.to);
    double rank = 0;
    if (step.stroke == no_stroke) {
      rank = 100;
    } else if (before != nullptr && before->stroke != no_stroke) {
      const FlatVector in = direction(*before, true);
      const FlatVector out = direction(step, false);
      rank = std::abs(std::atan2(cross(in, out), dot(in, out)));
    }
    const bool is_return = step.stroke != no_stroke && is_cut_[step.stroke];
    if (is_return) rank += 10;
    if (rank < best_rank) best = i;
    best_rank = std::min(rank, best_rank);
  }
  return best;
}

// Hierholzer: continues until no step is left, and inserts tours of the remaining strokes.
StrokeTourist::Path StrokeTourist::path_from(std::size_t start) {
  struct Visit {
    std::size_t node;
    TourStep by;
  };
  std::vector<Visit> visits = {{start, {}}};
  Path path;
  while (!visits.empty()) {
    const Visit& last = visits.back();
    const std::size_t next = next_step(last.node, visits.size() > 1 ? &last.by : nullptr);
    if (next == steps_.size()) {
      if (visits.size() > 1) path.push_back(last.by);
      visits.pop_back();
      continue;
    }
    is_gone_[next] = true;
    TourStep step = steps_[next];
    if (step.from != last.node) std::swap(step.from, step.to);
    if (step.stroke != no_stroke) is_cut_[step.stroke] = true;
    visits.push_back({step.to, step});
  }
  std::ranges::reverse(path);
  return path;
}

// Short travels from one tour to the next. A tour may be traversed from its end.
void StrokeTourist::order(std::vector<Path>& paths) const {
  std::vector<DrawnPoint> starts;
  const auto start_of = [&](const Path& path) { return place(path.front(), path.front().from); };
  const auto end_of = [&](const Path& path) { return place(path.back(), path.back().to); };
  for (const Path& path : paths) starts.push_back(start_of(path));
  constexpr std::uint64_t steps = 2'000'000;
  const std::vector<std::uint32_t> route = shorten_route(starts, tour_.park, tour_.park, steps);
  std::vector<Path> ordered;
  DrawnPoint at = tour_.park;
  for (std::size_t i = 0; i < route.size(); ++i) {
    Path& path = paths[route[i]];
    const DrawnPoint next = i + 1 < route.size() ? starts[route[i + 1]] : tour_.park;
    const DrawnPoint start = start_of(path);
    const DrawnPoint end = end_of(path);
    if (distance_nm(at, end) + distance_nm(start, next) < distance_nm(at, start) + distance_nm(end, next)) {
      std::ranges::reverse(path);
      for (TourStep& step : path) std::swap(step.from, step.to);
    }
    at = end_of(path);
    ordered.push_back(std::move(path));
  }
  paths = std::move(ordered);
}

MillRun reversed(const MillRun& run) {
  MillRun back(run.rbegin(), run.rend());
  for (std::size_t i = 0; i + 1 < back.size(); ++i) back[i].bulge = -run[run.size() - 2 - i].bulge;
  back.back().bulge = 0;
  return back;
}

void StrokeTourist::cut(const Path& path, std::vector<MillRun>& runs) {
  const auto is_lift = [](const TourStep& step) { return step.stroke == no_stroke; };
  for (auto first = path.begin(); first != path.end();) {
    const auto end = std::find_if(first, path.end(), is_lift);
    cut_run({first, end}, runs);
    first = end == path.end() ? end : end + 1;
  }
}

// A run neither begins nor ends with a return.
void StrokeTourist::cut_run(const Path& path, std::vector<MillRun>& runs) {
  std::size_t begin = path.size();
  std::size_t end = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (is_cut_[path[i].stroke]) continue;
    is_cut_[path[i].stroke] = true;
    begin = std::min(begin, i);
    end = i + 1;
  }
  MillRun run;
  for (std::size_t i = begin; i < end; ++i) {
    const TourStep& step = path[i];
    const CutterStroke& stroke = strokes_[step.stroke];
    const MillRun points = stroke.from == step.from ? stroke.points : reversed(stroke.points);
    if (!run.empty()) run.pop_back();
    run.insert(run.end(), points.begin(), points.end());
  }
  if (!run.empty()) runs.push_back(std::move(run));
}

std::vector<MillRun> StrokeTourist::runs() {
  std::vector<double> lengths;
  for (const CutterStroke& stroke : strokes_) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
      const MillPoint& a = stroke.points[i];
      const MillPoint& b = stroke.points[i + 1];
      length += std::hypot(way_nm(a.at, b.at, a.bulge), static_cast<double>(b.z.count - a.z.count));
    }
    lengths.push_back(length);
  }
  const ReturnChooser::Choice choice = ReturnChooser(strokes_, lengths, at_node_, tour_.lift_nm).choose();
  for (std::size_t i = 0; i < strokes_.size(); ++i) {
    add_step({strokes_[i].from, strokes_[i].to, i});
    if (choice.is_twice[i]) add_step({strokes_[i].from, strokes_[i].to, i});
  }
  std::vector<std::size_t> starts;
  for (const std::vector<std::size_t>& group : choice.groups) starts.push_back(add_lifts(group, choice.is_end));
  is_gone_.assign(steps_.size(), false);
  std::vector<Path> paths;
  for (const std::size_t start : starts) paths.push_back(path_from(start));
  std::erase_if(paths, [](const Path& path) { return path.empty(); });
  order(paths);
  is_cut_.assign(strokes_.size(), false);
  std::vector<MillRun> runs;
  for (const Path& path : paths) cut(path, runs);
  return runs;
}

}  // namespace

std::vector<MillRun> tour_strokes(const std::vector<CutterStroke>& strokes, std::size_t nodes, const StrokeTour& tour) {
  return strokes.empty() ? std::vector<MillRun>{} : StrokeTourist(strokes, nodes, tour).runs();
}

}  // namespace passo
