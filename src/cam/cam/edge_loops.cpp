#include "passo/cam/edge_loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "edge_grid.hpp"
#include "place_tree.hpp"
#include <fmt/format.h>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

constexpr Nanometres chords_of_board{250};
constexpr Nanometres same_place{1'000};  // what two programs, or two ways to draw an arc, make of one place

std::vector<PathPoint> turned_around(const std::vector<PathPoint>& points) {
  std::vector<PathPoint> turned;
  for (std::size_t i = points.size(); i-- > 0;) turned.push_back({points[i].at, i == 0 ? 0 : -points[i - 1].bulge});
  return turned;
}

// Whether the second half of the path is the first one backwards.
bool goes_back(const std::vector<PathPoint>& points) {
  for (std::size_t i = 0, k = points.size() - 1; i < k; ++i, --k) {
    if (points[i].at != points[k].at || points[i].bulge != -points[k - 1].bulge) return false;
  }
  return true;
}

bool is_same_place(DrawnPoint a, DrawnPoint b) {
  return std::abs(a.x.count - b.x.count) <= same_place.count && std::abs(a.y.count - b.y.count) <= same_place.count;
}

// Whether two loops have the same inside, wherever they begin, in either direction, and in any pieces.
bool have_same_inside(const DrawnRing& a, const DrawnRing& b) {
  if (a == b) return true;  // mostly so, and much faster
  const Region in_a = filled({a});
  const Region in_b = filled({b});
  if (in_a.empty() || in_b.empty()) return false;
  const Region between = united(subtracted(in_a, in_b), subtracted(in_b, in_a));
  return grown(between, {-same_place.count}).empty();
}

// Ends are numbered: 2 k is the start of the open path k, 2 k + 1 its end.
class EdgeJoiner {
 public:
  EdgeJoiner(const Drawing& drawing, Nanometres join, OpenRows open_rows, Diagnostics& diagnostics)
      : drawing_(drawing), join_(join), open_rows_(open_rows), diagnostics_(diagnostics) {}

  EdgeLoops loops() {
    collect();
    drop_overlaps();
    join_ends();
    std::vector<bool> is_used(open_.size());
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (!is_used[i]) follow(i, is_used);
    }
    drop_repeated();
    if (open_rows_ == OpenRows::slots) refuse_others();
    return std::move(found_);
  }

 private:
  DrawnPoint place(std::size_t end) const {
    const std::vector<PathPoint>& points = open_[end / 2].points;
    return end % 2 == 0 ? points.front().at : points.back().at;
  }
  void collect();
  bool is_new(const PathPoint& from, const PathPoint& to);
  bool is_new_arc(DrawnPoint from, DrawnPoint to, DrawnPoint middle);
  void collect_open(const DrawnPath& path);
  void drop_overlaps();
  void trim(std::uint32_t index, const EdgeGrid& grid);
  void join_ends();
  void follow(std::size_t path, std::vector<bool>& is_used);
  void drop_repeated();
  void refuse_others();
  std::optional<Nanometres> join_that_helps() const;
  void refuse(std::size_t first, std::size_t last, std::optional<Nanometres> join);
  void refuse_line(std::uint32_t line, const std::string& ends, std::optional<Nanometres> join);
  void append(std::vector<PathPoint>& loop, std::size_t first_end);

  const Drawing& drawing_;
  Nanometres join_;
  OpenRows open_rows_;
  Diagnostics& diagnostics_;
  bool is_trial_ = false;
  EdgeLoops found_;
  std::vector<DrawnPath> open_;
  std::set<std::tuple<DrawnPoint, DrawnPoint, DrawnPoint>> known_;  // ends and middles of their pieces
  struct DrawnArc {
    DrawnPoint from;
    DrawnPoint to;
    DrawnPoint middle;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<DrawnArc>> arcs_;  // by the place of their middles
  std::vector<std::optional<std::size_t>> partners_;                             // of each end
  std::vector<std::pair<std::size_t, std::size_t>> open_ends_;                   // of each row that is not closed
};

void EdgeJoiner::collect() {
  for (const DrawnHole& hole : drawing_.holes) {
    if (hole.diameter.count <= 0) continue;
    const std::int64_t radius = hole.diameter.count / 2;
    found_.loops.push_back(
        {{{{hole.at.x.count + radius}, hole.at.y}, 1}, {{{hole.at.x.count - radius}, hole.at.y}, 1}});
  }
  std::vector<DrawnPath> open;
  for (const DrawnPath& path : drawing_.paths) {
    if (path.points.size() < 2) continue;
    const DrawnPoint first = path.points.front().at;
    DrawnPath whole = path;
    if (path.is_closed && path.points.back().at != first) whole.points.push_back({first, 0});
    if (whole.points.back().at != first || goes_back(whole.points)) {
      open.push_back(std::move(whole));
      continue;
    }
    for (std::size_t i = 0; i + 1 < whole.points.size(); ++i) is_new(whole.points[i], whole.points[i + 1]);
    whole.points.pop_back();
    found_.loops.push_back(std::move(whole.points));
  }
  for (const DrawnPath& path : open) collect_open(path);
}

bool EdgeJoiner::is_new(const PathPoint& from, const PathPoint& to) {
  const DrawnPoint middle =
      from.at < to.at ? point_along(from.at, to.at, from.bulge, 0.5) : point_along(to.at, from.at, -from.bulge, 0.5);
  const bool is_exactly_new = known_.emplace(std::min(from.at, to.at), std::max(from.at, to.at), middle).second;
  return is_exactly_new && (from.bulge == 0 || is_new_arc(from.at, to.at, middle));
}

// Arcs that are drawn by their centre and angles, or in the other direction, differ by roundings.
bool EdgeJoiner::is_new_arc(DrawnPoint from, DrawnPoint to, DrawnPoint middle) {
  constexpr std::size_t most_in_cell = 32;
  constexpr std::int64_t cell = 4 * same_place.count;
  const std::pair place{middle.x.count / cell, middle.y.count / cell};
  for (std::int64_t x = place.first - 1; x <= place.first + 1; ++x) {
    for (std::int64_t y = place.second - 1; y <= place.second + 1; ++y) {
      const auto near = arcs_.find({x, y});
      if (near == arcs_.end()) continue;
      const bool is_known = std::ranges::any_of(near->second, [&](const DrawnArc& arc) {
        const bool same = is_same_place(arc.from, from) && is_same_place(arc.to, to);
        const bool turned = is_same_place(arc.from, to) && is_same_place(arc.to, from);
        return is_same_place(arc.middle, middle) && (same || turned);
      });
      if (is_known) return false;
    }
  }
  std::vector<DrawnArc>& here = arcs_[place];
  if (here.size() < most_in_cell) here.push_back({from, to, middle});
  return true;
}

// Layout programs draw an edge twice, part of it twice, or forth and back: each piece of an open path counts once.
void EdgeJoiner::collect_open(const DrawnPath& path) {
  std::vector<DrawnPath> parts(1, path);
  parts.back().points.resize(1);
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const PathPoint& from = path.points[i - 1];
    const PathPoint& to = path.points[i];
    const bool is_piece = from.at != to.at || from.bulge != 0;
    if (is_piece && is_new(from, to)) {
      parts.back().points.push_back(to);
    } else if (from.at != to.at) {
      parts.push_back(path);
      parts.back().points.assign(1, to);
    }
  }
  for (DrawnPath& part : parts) {
    if (part.points.size() < 2) continue;
    if (part.points.size() > 2 && part.points.front().at == part.points.back().at) {
      part.points.pop_back();
      found_.loops.push_back(std::move(part.points));
    } else {
      open_.push_back(std::move(part));
    }
  }
}

// Of two straight pieces on one line the shorter one loses what lies on the other.
void EdgeJoiner::drop_overlaps() {
  std::vector<DrawnPoint> corners;
  const auto add_corners = [&](const std::vector<PathPoint>& points) {
    for (const PathPoint& point : points) corners.push_back(point.at);
  };
  for (const std::vector<PathPoint>& loop : found_.loops) add_corners(loop);
  for (const DrawnPath& path : open_) add_corners(path.points);
  if (open_.empty()) return;
  EdgeGrid grid(box_of(corners), {1'000'000});
  constexpr std::uint32_t of_loop = 0xffffffff;
  const auto add_piece = [&](const PathPoint& from, const PathPoint& to, std::uint32_t owner) {
    if (from.bulge == 0 && from.at != to.at) grid.add({from.at, to.at}, owner);
  };
  for (const std::vector<PathPoint>& loop : found_.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) add_piece(loop[i], loop[(i + 1) % loop.size()], of_loop);
  }
  for (std::uint32_t i = 0; i < open_.size(); ++i) {
    if (open_[i].points.size() == 2) add_piece(open_[i].points[0], open_[i].points[1], i);
  }
  grid.finish();
  for (std::uint32_t i = 0; i < open_.size(); ++i) {
    if (open_[i].points.size() == 2 && open_[i].points[0].bulge == 0) trim(i, grid);
  }
  std::erase_if(open_, [](const DrawnPath& path) { return path.points.size() < 2; });
}

// `grid`: the pieces as they were. The owner of a piece is its index among the open paths.
void EdgeJoiner::trim(std::uint32_t index, const EdgeGrid& grid) {
  constexpr double beside = 1'000;  // nm
  std::vector<PathPoint>& points = open_[index].points;
  grid.for_near(points[0].at, points[1].at, beside, [&](std::uint32_t other) {
    const EdgeGrid::Edge& edge = grid.edge(other);
    if (edge.owner == index || points.size() < 2) return;
    const double length = distance_nm(points[0].at, points[1].at);
    const double of_other = distance_nm(edge.from, edge.to);
    const bool gives = length < of_other || (length == of_other && index > edge.owner) || edge.owner >= open_.size();
    const bool is_there = edge.owner >= open_.size() || open_[edge.owner].points.size() == 2;
    if (!gives || !is_there) return;
    const bool first_is_on = EdgeGrid::to_edge(points[0].at, edge).distance_nm <= beside;
    const bool second_is_on = EdgeGrid::to_edge(points[1].at, edge).distance_nm <= beside;
    if (first_is_on && second_is_on) {
      points.clear();
      return;
    }
    if (first_is_on == second_is_on) return;
    PathPoint& on = points[first_is_on ? 0 : 1];
    const DrawnPoint off = points[first_is_on ? 1 : 0].at;
    // Only an end of the other piece that lies on this one is where the two overlap.
    for (const DrawnPoint& end : {edge.from, edge.to}) {
      const bool is_on = EdgeGrid::to_edge(end, {on.at, off, 0}).distance_nm <= beside;
      if (is_on && distance_nm(end, on.at) > beside) on.at = end;
    }
  });
}

void EdgeJoiner::join_ends() {
  std::vector<DrawnPoint> places;
  for (std::size_t end = 0; end < 2 * open_.size(); ++end) places.push_back(place(end));
  partners_.assign(places.size(), std::nullopt);
  if (places.empty()) return;
  PlaceTree tree(places);
  struct Pair {
    double distance;
    std::size_t a;
    std::size_t b;
  };
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> near;
  for (std::uint32_t end = 0; end < places.size(); ++end) {
    constexpr std::size_t looked_at = 8;
    tree.nearest(end, looked_at, near);
    for (const std::uint32_t other : near) {
      const double distance = distance_nm(places[end], places[other]);
      if (distance > static_cast<double>(join_.count)) break;
      if (end < other || distance > 0) pairs.push_back({distance, std::min(end, other), std::max(end, other)});
    }
  }
  std::ranges::sort(pairs, {}, [](const Pair& pair) { return std::tuple(pair.distance, pair.a, pair.b); });
  for (const Pair& pair : pairs) {
    if (partners_[pair.a] || partners_[pair.b]) continue;
    partners_[pair.a] = pair.b;
    partners_[pair.b] = pair.a;
    if (pair.distance == 0) continue;
    ++found_.joined;
    found_.widest_joined = std::max(found_.widest_joined, Nanometres{std::llround(pair.distance)});
  }
}

// The path from this end of it on.
void EdgeJoiner::append(std::vector<PathPoint>& loop, std::size_t first_end) {
  const std::vector<PathPoint>& drawn = open_[first_end / 2].points;
  std::vector<PathPoint> points = first_end % 2 == 0 ? drawn : turned_around(drawn);
  points.back().bulge = 0;
  if (!loop.empty() && loop.back().at == points.front().at) loop.pop_back();
  loop.insert(loop.end(), points.begin(), points.end());
}

void EdgeJoiner::follow(std::size_t path, std::vector<bool>& is_used) {
  std::vector<PathPoint> loop;
  std::size_t end = 2 * path;
  // Back to where the row of paths begins, if it begins anywhere.
  for (std::size_t i = 0; i < open_.size() && partners_[end]; ++i) {
    end = *partners_[end] ^ 1U;
    if (end == 2 * path) break;
  }
  const std::size_t first = end;
  for (;;) {
    is_used[end / 2] = true;
    append(loop, end);
    const std::size_t far_end = end ^ 1U;
    if (!partners_[far_end]) {
      if (open_rows_ == OpenRows::refused) {
        refuse(first, far_end, join_that_helps());
      } else {
        found_.open.push_back(std::move(loop));
        open_ends_.emplace_back(first, far_end);
      }
      return;
    }
    end = *partners_[far_end];
    if (end == first) break;
  }
  if (loop.size() > 2 && loop.front().at == loop.back().at) loop.pop_back();
  if (loop.size() > 1) found_.loops.push_back(std::move(loop));
}

// Of loops that are the same, the first counts. A second one would be an opening as large as what it is in, and neither
// would be left.
void EdgeJoiner::drop_repeated() {
  struct Place {
    double key;
    std::size_t loop;
    DrawnBox box;
    DrawnRing ring;
  };
  // One number for a box, so that few are compared. With these factors, boxes in a row or column have different ones.
  constexpr std::array factors = {1.0, 2.236, 3.317, 4.123};
  constexpr double beside = static_cast<double>(same_place.count) * (factors[0] + factors[1] + factors[2] + factors[3]);
  std::vector<Place> places;
  for (std::size_t i = 0; i < found_.loops.size(); ++i) {
    DrawnRing ring = chords_of_path(found_.loops[i], true, chords_of_board);
    const DrawnBox box = box_of(ring);
    const double key =
        factors[0] * static_cast<double>(box.least.x.count) + factors[1] * static_cast<double>(box.least.y.count) +
        factors[2] * static_cast<double>(box.most.x.count) + factors[3] * static_cast<double>(box.most.y.count);
    places.push_back({key, i, box, std::move(ring)});
  }
  std::ranges::sort(places, {}, [](const Place& place) { return std::pair(place.key, place.loop); });
  std::vector<bool> is_repeated(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& one = places[i];
    for (std::size_t k = i + 1; k < places.size() && places[k].key - one.key <= beside; ++k) {
      const Place& other = places[k];
      if (is_repeated[one.loop] || is_repeated[other.loop]) continue;
      if (!is_same_place(one.box.least, other.box.least) || !is_same_place(one.box.most, other.box.most)) continue;
      if (have_same_inside(one.ring, other.ring)) is_repeated[std::max(one.loop, other.loop)] = true;
    }
  }
  std::vector<std::vector<PathPoint>> kept;
  for (std::size_t i = 0; i < found_.loops.size(); ++i) {
    if (!is_repeated[i]) kept.push_back(std::move(found_.loops[i]));
  }
  found_.repeated = found_.loops.size() - kept.size();
  found_.loops = std::move(kept);
}

// A line within the board whose ends are far from each other, and from other ends, is a slot. Anything else that is
// open is refused.
void EdgeJoiner::refuse_others() {
  constexpr double far = 1e6;  // nm
  const Region board = board_within(found_);
  std::vector<std::vector<PathPoint>> slots;
  std::vector<std::pair<std::size_t, std::size_t>> refused;
  for (std::size_t i = 0; i < open_ends_.size(); ++i) {
    const auto& [first, last] = open_ends_[i];
    const auto is_apart = [&](std::size_t end) {
      for (const auto& [a, b] : open_ends_) {
        for (const std::size_t other : {a, b}) {
          if (other != end && distance_nm(place(end), place(other)) < far) return false;
        }
      }
      return true;
    };
    const bool is_slot = !board.empty() && contains(board, place(first)) && contains(board, place(last)) &&
                         is_apart(first) && is_apart(last);
    if (is_slot) {
      slots.push_back(std::move(found_.open[i]));
    } else {
      refused.push_back(open_ends_[i]);
    }
  }
  found_.open = std::move(slots);
  if (refused.empty()) return;
  const std::optional<Nanometres> join = join_that_helps();
  for (const auto& [first, last] : refused) refuse(first, last, join);
}

// The --join that closes all rows, if there is one: it was tried. No loop may be without an inside.
std::optional<Nanometres> EdgeJoiner::join_that_helps() const {
  constexpr std::int64_t step = 10'000;
  constexpr std::size_t most_ends = 200;
  if (is_trial_) return std::nullopt;
  std::vector<std::size_t> ends;
  for (std::size_t end = 0; end < partners_.size(); ++end) {
    if (!partners_[end]) ends.push_back(end);
  }
  if (ends.size() > most_ends) return std::nullopt;
  double widest = 0;
  for (const std::size_t end : ends) {
    double nearest = 1e300;
    for (const std::size_t other : ends) {
      if (other != end) nearest = std::min(nearest, distance_nm(place(end), place(other)));
    }
    widest = std::max(widest, nearest);
  }
  if (widest > 1e9) return std::nullopt;
  const Nanometres join{(std::llround(widest) + step - 1) / step * step};
  Diagnostics none;
  EdgeJoiner trial(drawing_, join, OpenRows::kept, none);
  trial.is_trial_ = true;
  const EdgeLoops loops = trial.loops();
  if (!loops.open.empty() || loops.loops.size() <= found_.loops.size()) return std::nullopt;
  constexpr double least_mm2 = 0.01;
  for (const std::vector<PathPoint>& loop : loops.loops) {
    if (area_mm2(filled({chords_of_path(loop, true, chords_of_board)})) < least_mm2) return std::nullopt;
  }
  return area_mm2(board_within(loops)) > 0.9 * area_mm2(board_within(found_)) ? std::optional(join) : std::nullopt;
}

// Both ends of a row: in one error if one line of the file has drawn both.
void EdgeJoiner::refuse(std::size_t first, std::size_t last, std::optional<Nanometres> join) {
  const auto words = [&](std::size_t end) {
    return fmt::format("X{:.4g} Y{:.4g}", to_mm(place(end).x).value(), to_mm(place(end).y).value());
  };
  const std::uint32_t line = open_[first / 2].line;
  const std::uint32_t other_line = open_[last / 2].line;
  if (line == other_line) return refuse_line(line, words(first) + " and at " + words(last), join);
  refuse_line(line, words(first), join);
  refuse_line(other_line, words(last), join);
}

void EdgeJoiner::refuse_line(std::uint32_t line, const std::string& ends, std::optional<Nanometres> join) {
  if (diagnostics_.full()) return;
  std::string expected = "a closed line";
  if (join) expected += fmt::format("; --join {:.4g}mm closes it", to_mm(*join).value());
  diagnostics_.add({.code = "outline.open",
                    .file = drawing_.file,
                    .place = {line, line == 0 ? 0U : 1U, 1},
                    .message = fmt::format("the outline is open: it ends at {} mm", ends),
                    .expected = std::move(expected),
                    .text = ""});
}

}  // namespace

DrawnRing chords_of_path(const std::vector<PathPoint>& points, bool is_closed, Nanometres tolerance) {
  DrawnRing ring;
  const std::size_t count = points.size() - (is_closed ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i) {
    const DrawnPoint from = points[i].at;
    const DrawnPoint to = points[(i + 1) % points.size()].at;
    ring.push_back(from);
    const std::size_t pieces = chords_on(from, to, points[i].bulge, tolerance);
    for (std::size_t k = 1; k < pieces; ++k) {
      ring.push_back(point_along(from, to, points[i].bulge, static_cast<double>(k) / static_cast<double>(pieces)));
    }
  }
  if (!is_closed) ring.push_back(points.back().at);
  return ring;
}

EdgeLoops edge_loops(const Drawing& drawing, Nanometres join, Diagnostics& diagnostics, OpenRows open_rows) {
  return EdgeJoiner(drawing, join, open_rows, diagnostics).loops();
}

Region board_within(const EdgeLoops& loops) {
  std::vector<Region> all;
  for (const std::vector<PathPoint>& loop : loops.loops) {
    all.push_back(filled({chords_of_path(loop, true, chords_of_board)}));
  }
  std::ranges::stable_sort(all, [](const Region& a, const Region& b) { return area_mm2(a) > area_mm2(b); });
  Region board;
  for (const Region& loop : all) {
    if (loop.empty()) continue;
    // Loops do not cross: what is in the board so far becomes an opening.
    const DrawnPoint inside = loop.rings.front().front();
    board = contains(board, inside) ? subtracted(board, loop) : united(board, loop);
  }
  return board;
}

}  // namespace passo
