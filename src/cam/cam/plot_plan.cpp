#include "passo/cam/plot_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flat_vector.hpp"
#include "nested_loops.hpp"
#include "place_tree.hpp"

#include "passo/cam/bulge.hpp"
#include "passo/cam/route.hpp"

namespace passo {
namespace {

using PlotPath = std::vector<PathPoint>;

struct PlotLine {
  PlotPath points;  // of a closed line without its first point at the end
  bool is_closed = false;
  std::size_t rank = 0;  // lines of a lower rank come first
};

PlotPath turned_back(const PlotPath& points) {
  PlotPath turned(points.rbegin(), points.rend());
  for (std::size_t i = 0; i + 1 < turned.size(); ++i) turned[i].bulge = -points[points.size() - 2 - i].bulge;
  turned.back().bulge = 0;
  return turned;
}

// The closed path from this point around to the same point.
PlotPath around_from(const PlotPath& points, std::size_t first) {
  PlotPath path = points;
  std::rotate(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
  path.push_back({path.front().at, 0});
  return path;
}

// The directions in which a piece begins and ends, of length 1.
struct PieceEnds {
  FlatVector first;
  FlatVector last;
};
PieceEnds directions_of(const PathPoint& from, const PathPoint& to) {
  const FlatVector chord = from_to(from.at, to.at);
  const double length = std::hypot(chord.x, chord.y);
  const double lean = sweep_of(from.bulge) / 2;
  const double c = std::cos(lean) / length;
  const double s = std::sin(lean) / length;
  return {{chord.x * c + chord.y * s, chord.y * c - chord.x * s},
          {chord.x * c - chord.y * s, chord.y * c + chord.x * s}};
}

class PlotPlanner {
 public:
  PlotPlanner(const PlotOptions& options) : options_(options), has_knife_(options.knife.count > 0) {}

  PlotPlan plan(std::vector<PlotLine> lines) {
    std::ranges::stable_sort(lines, {}, &PlotLine::rank);
    for (auto first = lines.begin(); first != lines.end();) {
      const auto end = std::find_if(first, lines.end(), [&](const PlotLine& line) { return line.rank != first->rank; });
      draw({std::make_move_iterator(first), std::make_move_iterator(end)});
      first = end;
    }
    plan_.travel_nm += distance_nm(at_, options_.park);
    return std::move(plan_);
  }

 private:
  void draw(std::vector<PlotLine> lines);
  std::vector<PlotPath> by_nearest(const std::vector<PlotLine>& lines) const;
  double travel(const std::vector<PlotPath>& paths) const;
  void add(const PlotPath& path, bool is_closed);
  PlotPath with_overcut(PlotPath path) const;
  PlotPath of_axis(const PlotPath& path);
  DrawnPoint ahead(DrawnPoint tip, FlatVector direction) const {
    const auto offset = static_cast<double>(options_.knife.count);
    return shifted(tip, {direction.x * offset, direction.y * offset});
  }

  const PlotOptions& options_;
  bool has_knife_;
  DrawnPoint at_ = options_.park;
  FlatVector heading_{1, 0};  // of the blade, from its tip to the axis
  PlotPlan plan_;
};

// Greedy: the next line is the one with the nearest end (open) or the nearest point (closed).
std::vector<PlotPath> PlotPlanner::by_nearest(const std::vector<PlotLine>& lines) const {
  std::vector<DrawnPoint> places;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> entries;  // line and point
  std::vector<std::uint32_t> firsts;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    firsts.push_back(static_cast<std::uint32_t>(places.size()));
    const auto count = static_cast<std::uint32_t>(lines[i].points.size());
    const std::uint32_t step = lines[i].is_closed ? 1 : std::max(1U, count - 1);
    for (std::uint32_t k = 0; k < count; k += step) {
      places.push_back(lines[i].points[k].at);
      entries.emplace_back(i, k);
    }
  }
  firsts.push_back(static_cast<std::uint32_t>(places.size()));
  PlaceTree left(places);
  std::vector<PlotPath> paths;
  DrawnPoint at = at_;
  for (std::size_t done = 0; done < lines.size(); ++done) {
    const auto [line, point] = entries[left.nearest_left(at)];
    for (std::uint32_t place = firsts[line]; place < firsts[line + 1]; ++place) left.forget(place);
    const PlotLine& next = lines[line];
    paths.push_back(next.is_closed ? around_from(next.points, point)
                    : point == 0   ? next.points
                                   : turned_back(next.points));
    at = paths.back().back().at;
  }
  return paths;
}

double PlotPlanner::travel(const std::vector<PlotPath>& paths) const {
  DrawnPoint at = at_;
  double length = 0;
  for (const PlotPath& path : paths) length += distance_nm(std::exchange(at, path.back().at), path.front().at);
  return length + distance_nm(at, options_.park);
}

void PlotPlanner::draw(std::vector<PlotLine> lines) {
  std::vector<PlotPath> paths = by_nearest(lines);
  std::vector<DrawnPoint> starts;
  for (const PlotPath& path : paths) starts.push_back(path.front().at);
  constexpr std::uint64_t enough_a_place = 2'000;
  const std::uint64_t steps = std::min(options_.route_steps, enough_steps(starts.size(), enough_a_place));
  std::vector<PlotPath> shorter;
  for (const std::uint32_t index : shorten_route(starts, at_, options_.park, steps)) shorter.push_back(paths[index]);
  if (travel(shorter) < travel(paths)) paths = std::move(shorter);
  for (const PlotPath& path : paths) {
    add(path, path.size() > 2 && path.front().at == path.back().at);
  }
}

void PlotPlanner::add(const PlotPath& path, bool is_closed) {
  const bool is_dot = path.size() == 1;
  ++(is_dot ? plan_.dots : is_closed ? plan_.closed : plan_.open);
  PlotPath moves = has_knife_ ? of_axis(is_closed ? with_overcut(path) : path) : path;
  plan_.travel_nm += distance_nm(at_, moves.front().at);
  at_ = moves.back().at;
  for (std::size_t i = 0; i + 1 < moves.size(); ++i) {
    plan_.drawn_nm += way_nm(moves[i].at, moves[i + 1].at, moves[i].bulge);
  }
  plan_.paths.push_back(std::move(moves));
}

PlotPath PlotPlanner::with_overcut(PlotPath path) const {
  auto left = static_cast<double>(options_.overcut.count);
  const std::size_t count = path.size();
  for (std::size_t i = 0; i + 1 < count && left > 0; ++i) {
    const PathPoint from = path[i];
    const DrawnPoint to = path[i + 1].at;
    const double length = way_nm(from.at, to, from.bulge);
    if (length <= 0) continue;
    const double share = std::min(1.0, left / length);
    path.back().bulge = share == 1 ? from.bulge : std::tan(sweep_of(from.bulge) * share / 4);
    path.push_back({share == 1 ? to : point_along(from.at, to, from.bulge, share), 0});
    left -= length;
  }
  return path;
}

// The path of the axis for a path of the tip. On an arc, the axis follows an arc with the same sweep.
PlotPath PlotPlanner::of_axis(const PlotPath& path) {
  PlotPath moves = {{ahead(path.front().at, heading_), 0}};
  const double least_turn = options_.swivel_degrees / 180 * std::numbers::pi;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i].at == path[i + 1].at) continue;
    const PieceEnds along = directions_of(path[i], path[i + 1]);
    const double turn = std::atan2(cross(heading_, along.first), dot(heading_, along.first));
    const DrawnPoint start = ahead(path[i].at, along.first);
    if (moves.back().at != start) {
      const bool swivels = std::abs(turn) > least_turn;
      moves.back().bulge = swivels ? std::tan(turn / 4) : 0;
      moves.push_back({start, 0});
    }
    moves.back().bulge = path[i].bulge;
    moves.push_back({ahead(path[i + 1].at, along.last), 0});
    heading_ = along.last;
  }
  return moves;
}

std::vector<PlotLine> lines_of(const EdgeLoops& lines, bool inner_first) {
  std::vector<PlotLine> all;
  for (const PlotPath& line : lines.open) all.push_back({line, false, 0});
  std::vector<NestedLoop> nested;
  constexpr Nanometres tolerance{10'000};
  if (inner_first) nested = nest(lines.loops, tolerance);
  // nest() drops loops that enclose no area.
  const bool knows_nesting = inner_first && nested.size() == lines.loops.size();
  const std::size_t deepest = knows_nesting ? deepest_of(nested) : 0;
  for (std::size_t i = 0; i < lines.loops.size(); ++i) {
    all.push_back({lines.loops[i], true, knows_nesting ? 1 + deepest - nested[i].around : 1});
  }
  if (!inner_first) {
    for (PlotLine& line : all) line.rank = 0;
  }
  std::erase_if(all, [](const PlotLine& line) { return line.points.empty(); });
  return all;
}

}  // namespace

std::vector<DrawnPoint> take_dots(Drawing& drawing) {
  std::vector<DrawnPoint> dots;
  for (const DrawnHole& hole : drawing.holes) {
    if (hole.diameter.count <= 0) dots.push_back(hole.at);
  }
  std::erase_if(drawing.holes, [](const DrawnHole& hole) { return hole.diameter.count <= 0; });
  const auto is_dot = [](const DrawnPath& path) {
    return std::ranges::all_of(path.points, [&](const PathPoint& point) { return point.at == path.points.front().at; });
  };
  for (const DrawnPath& path : drawing.paths) {
    if (!path.points.empty() && is_dot(path)) dots.push_back(path.points.front().at);
  }
  std::erase_if(drawing.paths, is_dot);
  std::ranges::sort(dots);
  dots.erase(std::unique(dots.begin(), dots.end()), dots.end());
  return dots;
}

PlotPlan plan_plot(const EdgeLoops& lines, const PlotOptions& options) {
  return PlotPlanner(options).plan(lines_of(lines, options.inner_first || options.knife.count > 0));
}

}  // namespace passo
