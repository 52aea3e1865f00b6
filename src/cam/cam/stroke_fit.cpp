#include "stroke_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "flat_vector.hpp"

namespace passo {
namespace {

// Joins strokes at nodes where exactly two of them meet.
class StrokeJoiner {
 public:
  StrokeJoiner(std::vector<CutterStroke> strokes, std::size_t nodes)
      : strokes_(std::move(strokes)), is_used_(strokes_.size()), at_node_(nodes) {
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      at_node_[strokes_[i].from].push_back(i);
      at_node_[strokes_[i].to].push_back(i);
    }
  }

  std::vector<CutterStroke> join() {
    for (std::size_t node = 0; node < at_node_.size(); ++node) {
      if (at_node_[node].size() != 2) join_from(node);
    }
    // The remaining strokes form rings.
    for (std::size_t node = 0; node < at_node_.size(); ++node) join_from(node);
    return std::move(joined_);
  }

 private:
  void join_from(std::size_t node) {
    for (const std::size_t first : at_node_[node]) {
      if (is_used_[first]) continue;
      CutterStroke whole{node, node, {}};
      for (std::size_t next = first; next < strokes_.size(); next = next_at(whole.to)) append(next, whole);
      joined_.push_back(std::move(whole));
    }
  }
  std::size_t next_at(std::size_t node) const {
    if (at_node_[node].size() != 2) return strokes_.size();
    const auto next = std::ranges::find_if(at_node_[node], [&](std::size_t i) { return !is_used_[i]; });
    return next == at_node_[node].end() ? strokes_.size() : *next;
  }
  void append(std::size_t index, CutterStroke& whole) {
    is_used_[index] = true;
    CutterStroke& piece = strokes_[index];
    const bool is_ahead = piece.from == whole.to;
    if (!is_ahead) std::ranges::reverse(piece.points);
    for (const MillPoint& point : piece.points) {
      const bool is_same =
          !whole.points.empty() && whole.points.back().at == point.at && whole.points.back().z == point.z;
      if (!is_same) whole.points.push_back(point);
    }
    whole.to = is_ahead ? piece.to : piece.from;
  }

  std::vector<CutterStroke> strokes_;
  std::vector<bool> is_used_;
  std::vector<std::vector<std::size_t>> at_node_;
  std::vector<CutterStroke> joined_;
};

struct FittedPiece {
  std::size_t last;  // index of the point where it ends
  double sweep;      // 0: a line
};

class PieceFitter {
 public:
  PieceFitter(const MillRun& points, const StrokeFit& fit) : points_(points), fit_(fit) {}

  // The line or the arc that begins here and replaces the most points.
  FittedPiece longest(std::size_t first) const {
    const FittedPiece line = longest_of(first, 1, [&](std::size_t last) { return line_to(first, last); });
    constexpr std::size_t fewest_chords = 3;
    const FittedPiece arc = longest_of(first, fewest_chords, [&](std::size_t last) { return arc_to(first, last); });
    return arc.last > line.last ? arc : line;
  }

 private:
  // Each trial checks all points of a piece, so the number of points is found by doubling, then by bisection.
  template <class Piece>
  FittedPiece longest_of(std::size_t first, std::size_t fewest, Piece piece_to) const {
    FittedPiece found{first + 1, 0};
    std::size_t next = first + fewest;
    std::size_t leap = 1;
    bool is_first = true;
    for (bool grows = true; leap > 0; next = found.last + leap) {
      const std::optional<FittedPiece> longer = next < points_.size() ? piece_to(next) : std::nullopt;
      if (!longer && is_first) return found;
      is_first = false;
      if (longer) found = *longer;
      grows = grows && longer;
      leap = grows ? 2 * leap : leap / 2;
    }
    return found;
  }

  double height(std::size_t i) const { return static_cast<double>(points_[i].z.count); }
  bool is_near(double off_xy, double off_z) const { return off_xy + fit_.slope * std::abs(off_z) <= fit_.tolerance_nm; }
  // Along a piece the cutter moves forward, as along the points.
  std::optional<FittedPiece> line_to(std::size_t first, std::size_t last) const;
  std::optional<FittedPiece> arc_to(std::size_t first, std::size_t last) const;

  const MillRun& points_;
  const StrokeFit& fit_;
};

std::optional<FittedPiece> PieceFitter::line_to(std::size_t first, std::size_t last) const {
  const FlatVector way = from_to(points_[first].at, points_[last].at);
  const double length = std::hypot(way.x, way.y);
  const double rise = height(last) - height(first);
  double before = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    if (length <= 0) return std::nullopt;
    const FlatVector to = from_to(points_[first].at, points_[i].at);
    const double share = dot(to, way) / (length * length);
    if (share < before || share > 1) return std::nullopt;
    before = share;
    if (!is_near(std::abs(cross(way, to)) / length, height(i) - height(first) - share * rise)) return std::nullopt;
  }
  return FittedPiece{last, 0};
}

std::optional<FittedPiece> PieceFitter::arc_to(std::size_t first, std::size_t last) const {
  const DrawnPoint a = points_[first].at;
  const FlatVector to_middle = from_to(a, points_[(first + last) / 2].at);
  const FlatVector to_last = from_to(a, points_[last].at);
  const double twice = 2 * cross(to_middle, to_last);
  if (std::abs(twice) < 1) return std::nullopt;
  const FlatVector centre = centre_of_circle(to_middle, to_last);  // from a
  const double radius = std::hypot(centre.x, centre.y);
  constexpr double widest = 1e9;     // nm; flatter is a line
  constexpr double narrowest = 5e4;  // nm; smaller arcs suffer from the last digit of a program
  if (radius > widest || radius < narrowest) return std::nullopt;
  std::vector<double> turns = {0};
  FlatVector before{-centre.x, -centre.y};
  for (std::size_t i = first + 1; i <= last; ++i) {
    const FlatVector from_a = from_to(a, points_[i].at);
    const FlatVector now{from_a.x - centre.x, from_a.y - centre.y};
    const double turn = std::atan2(cross(before, now), dot(before, now));
    if (turn * twice <= 0) return std::nullopt;
    // The chord itself lies inside the circle.
    if (radius * (1 - std::cos(turn / 2)) > fit_.tolerance_nm) return std::nullopt;
    turns.push_back(turns.back() + turn);
    before = now;
  }
  constexpr double most = std::numbers::pi;
  const double sweep = turns.back();
  if (std::abs(sweep) > most) return std::nullopt;
  const double rise = height(last) - height(first);
  double off_before = 0;
  for (std::size_t i = first + 1; i <= last; ++i) {
    const FlatVector from_a = from_to(a, points_[i].at);
    const double off = std::hypot(from_a.x - centre.x, from_a.y - centre.y) - radius;
    const double share = turns[i - first] / sweep;
    const double off_z = height(i) - height(first) - share * rise;
    const double bow = radius * (1 - std::cos((turns[i - first] - turns[i - first - 1]) / 2));
    if (!is_near(std::max(std::abs(off), std::abs((off + off_before) / 2 - bow)), off_z)) return std::nullopt;
    off_before = off;
  }
  return FittedPiece{last, sweep};
}

MillRun fitted(const MillRun& points, const StrokeFit& fit) {
  const PieceFitter fitter(points, fit);
  MillRun run;
  for (std::size_t at = 0; at + 1 < points.size();) {
    const FittedPiece piece = fitter.longest(at);
    run.push_back({points[at].at, std::tan(piece.sweep / 4), points[at].z});
    at = piece.last;
  }
  run.push_back({points.back().at, 0, points.back().z});
  return run;
}

}  // namespace

std::vector<CutterStroke> fit_strokes(std::vector<CutterStroke> strokes, std::size_t nodes, const StrokeFit& fit) {
  std::vector<CutterStroke> joined = StrokeJoiner(std::move(strokes), nodes).join();
  std::erase_if(joined, [](const CutterStroke& stroke) { return stroke.points.size() < 2; });
  for (CutterStroke& stroke : joined) stroke.points = fitted(stroke.points, fit);
  return joined;
}

}  // namespace passo
