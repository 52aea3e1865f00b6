#include "knot_placer.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Changes of curvature, alike: w² = 10 e / change.
constexpr double bend_width = 10;
// On arcs, in radii.
constexpr double arc_width = 0.4;
// Between nodes on fitted curves, in radii: the bend of the spline, a polygon, is then within a thousandth of an arc's.
// A fit turns by a radian or two, so that few knots are needed, and never more than so many.
constexpr double knots_on_bend = 0.08;
constexpr double most_on_bend = 64;
// Changes smaller than this (of a unit tangent; 1/mm) are rounding.
constexpr double no_change = 1e-9;

// Junctions make one node while the way from the first to the last is within this share of its width, and while
// passing them as one would leave the path by no more than a part of the tolerance.
constexpr double cluster_share = 0.5;
constexpr double cluster_tube = 0.5;

constexpr std::array knots_for_least_bending = {0.5, 1.0, 1.5};
constexpr std::array knots_for_slow_bending = {0.5, 1.0, 1.6, 2.2};
constexpr double last_knot_reaches = 1.25;  // so much room belongs to a node, in the last knot's distance
constexpr double share_of_room = 0.9;       // a knot nearer than this to the end of the room is left out

// A gap so many times as wide as the knots' distance beside it stays exact: a shorter one bends less as part of the
// stretches beside it.
constexpr double exact_from = 3;
constexpr std::size_t least_knots = 3;  // on each side of an exact piece
// Shorter lines (mm) have no good direction after they are cut.
constexpr double least_exact = 1e-6;

constexpr double unlimited = 1e9;

}  // namespace

struct KnotPlacer::Spacing {
  // Corners: the curve that turns by `change` within the width w and leaves the corner by e has w = 4 e / change. Wider
  // ones, which cannot use all of their width, are found to be better for slow bending.
  double corner_width = 4;
  std::span<const double> knots;  // in widths from the node
  // How much faster s goes on w times the change of the tangent away from a corner than at it.
  double quickening = 0;
};

const KnotPlacer::Spacing& KnotPlacer::spacing_for(Smoothness smoothness) {
  static constexpr Spacing least_bending = {.corner_width = 4, .knots = knots_for_least_bending, .quickening = 0};
  static constexpr Spacing slow_bending = {.corner_width = 5, .knots = knots_for_slow_bending, .quickening = 0.6};
  return smoothness == Smoothness::slow_bending ? slow_bending : least_bending;
}

KnotPlacer::KnotPlacer(RunReader& reader, Smoothness smoothness) : reader_(reader), spacing_(spacing_for(smoothness)) {}

void KnotPlacer::begin() {
  junction_ = reader_.begin();
  nodes_[1] = {.s = 0, .width = 0, .turn = 0, .before = junction_, .after = junction_};
  known_ = 2;
  all_found_ = false;
  in_stretch_ = false;
  knot_piece_ = junction_;
  steps_.clear();
  at_ = 0;
}

bool KnotPlacer::next(Mark& mark) {
  while (at_ == steps_.size()) {
    steps_.clear();
    at_ = 0;
    while (known_ < 4 && !all_found_) {
      if (find_node(nodes_[known_])) ++known_;
    }
    if (known_ < 3) return false;
    fill_gap();
    std::shift_left(nodes_.begin(), nodes_.end(), 1);
    --known_;
  }
  mark = steps_[at_].mark;
  knot_ = steps_[at_].knot;
  if (mark == Mark::exact_piece) exact_ = gap_exact_;
  ++at_;
  return true;
}

// The end of the run is a node too, of no width.
bool KnotPlacer::find_node(Node& node) {
  const std::uint64_t first = junction_;
  if (!reader_.has(first + 1)) {
    node = {.s = piece(first).end(), .width = 0, .turn = 0, .before = first, .after = first};
    all_found_ = true;
    return true;
  }
  Cluster cluster{.first = first, .last = first, .tube = std::min(piece(first).tube, piece(first + 1).tube)};
  if (goes_on(piece(first), piece(first + 1))) {  // there is nothing to round
    node.s = piece(first).end();
    node.width = 0;
    node.turn = 0;
  } else {
    while (cluster.last - first + 1 < most_clustered && extend(cluster)) {
    }
    node.s = (piece(first).end() + piece(cluster.last).end()) / 2;
    node.width = width_of(cluster);
    node.turn = turn_of(cluster);
  }
  node.before = first;
  node.after = cluster.last + 1;
  junction_ = node.after;
  return true;
}

double KnotPlacer::width_of(const Cluster& cluster) const {
  const Piece& before = piece(cluster.first);
  const Piece& after = piece(cluster.last + 1);
  double width = unlimited;
  const double turn = distance(before.last_tangent, after.first_tangent);
  if (turn > no_change) width = std::min(width, spacing_.corner_width * cluster.tube / turn);
  if (before.is_line() && after.is_line()) return width;
  const double change = distance(before.last_bend, after.first_bend);
  if (change > no_change) width = std::min(width, std::sqrt(bend_width * cluster.tube / change));
  return std::min(width, arc_width / std::max(length_of(before.last_bend), length_of(after.first_bend)));
}

// How sharp a corner it is. In a thread s is what the spindle is followed by, and stays the parameter.
double KnotPlacer::turn_of(const Cluster& cluster) const {
  const Piece& before = piece(cluster.first);
  const Piece& after = piece(cluster.last + 1);
  const bool follows = before.segment.lock != SpindleLock::none || after.segment.lock != SpindleLock::none;
  return follows ? 0 : distance(before.last_tangent, after.first_tangent);
}

// Whether tangent and second derivative go on without a change.
bool KnotPlacer::goes_on(const Piece& before, const Piece& after) {
  return distance(before.last_tangent, after.first_tangent) <= no_change &&
         distance(before.last_bend, after.first_bend) <= no_change;
}

// Takes in the next junction where it may.
bool KnotPlacer::extend(Cluster& cluster) {
  const std::uint64_t next = cluster.last + 1;
  if (!reader_.has(next + 1)) return false;
  const Piece& between = piece(next);
  Cluster larger = cluster;
  larger.last = next;
  larger.tube = std::min(larger.tube, piece(next + 1).tube);
  const double extent = between.end() - piece(cluster.first).end();
  if (extent > cluster_share * width_of(larger)) return false;
  const Point& direction = piece(cluster.first).last_tangent;
  larger.turn = std::max(larger.turn, distance(between.first_tangent, direction));
  if (!between.is_line()) {
    larger.turn += between.segment.curve.curvature() * between.length;
  }
  if (extent * larger.turn > cluster_tube * larger.tube) return false;
  cluster = larger;
  return true;
}

// Its width, but not farther than the nodes beside it.
double KnotPlacer::room_of(const Node& node, const Node& before, const Node& after) {
  return std::min({node.width, node.s - before.s, after.s - node.s});
}

void KnotPlacer::fill_gap() {
  const Node& from = nodes_[1];
  const Node& to = nodes_[2];
  const bool is_last = known_ == 3;
  knot_piece_ = std::max(knot_piece_, from.before);
  const double length = to.s - from.s;
  const double width = from.width > 0 ? room_of(from, nodes_[0], to) : 0;
  const double next_width = to.width > 0 ? room_of(to, from, nodes_[3]) : 0;

  // Each node's share of the room, and its knots in there.
  double room = 0;
  double next_room = 0;
  if (width > 0 && next_width > 0) {
    const double reaches = last_knot_reaches * spacing_.knots.back();
    room = std::min(reaches * width, length / 2);
    next_room = std::min(reaches * next_width, length - room);
    room = std::min(reaches * width, length - next_room);
  } else if (width > 0) {
    room = share_of_room * length;
  } else if (next_width > 0) {
    next_room = share_of_room * length;
  }
  const auto count = [&](double w, double within) {
    return static_cast<std::size_t>(
        std::ranges::count_if(spacing_.knots, [&](double k) { return w > 0 && k * w < share_of_room * within; }));
  };
  const std::size_t knots = count(width, room) + 1;  // with the node
  const std::size_t next_knots = count(next_width, next_room);
  const auto offset = [&](std::size_t i) { return i == 0 ? 0 : spacing_.knots[i - 1] * width; };
  const auto next_offset = [&](std::size_t i) { return i == 0 ? 0 : spacing_.knots[i - 1] * next_width; };

  const double first = from.s + offset(knots - 1);
  const double last = to.s - next_offset(next_knots);
  double spacing = knots > 1 ? offset(knots - 1) - offset(knots - 2) : 0;
  if (next_knots > 0) spacing = std::max(spacing, next_offset(next_knots) - next_offset(next_knots - 1));

  const Piece& between = piece(from.after);
  const bool is_whole = width == 0 && next_width == 0;
  const bool is_long = last - first > std::max(exact_from * spacing, least_exact);
  const bool has_knots = (width == 0 || knots >= least_knots) && (next_width == 0 || next_knots >= least_knots);
  const bool in_one_piece = first >= between.start && (next_width > 0 ? last < between.end() : last <= between.end());
  const bool exact = is_whole || (is_long && has_knots && in_one_piece && !between.is_fitted);

  if (in_stretch_ || width > 0 || !exact) {
    for (std::size_t i = 0; i < knots; ++i) add_knot(from.s + offset(i), rate_at(from, i, knots));
  }
  if (exact) {
    if (in_stretch_) steps_.push_back({.mark = Mark::end_of_stretch, .knot = {}});
    in_stretch_ = false;
    gap_exact_ = {.piece = from.after,
                  .from = first - between.start,
                  .to = next_width > 0 ? last - between.start : between.length};
    steps_.push_back({.mark = Mark::exact_piece, .knot = {}});
  }
  if (!exact && between.is_fitted) add_knots_on_bend(first, last, spacing);
  for (std::size_t i = next_knots; i > 0; --i) add_knot(to.s - next_offset(i), rate_at(to, i, next_knots + 1));
  if (is_last && in_stretch_) {
    add_knot(to.s);
    steps_.push_back({.mark = Mark::end_of_stretch, .knot = {}});
  }
}

// Where the path between two nodes was fitted, it is smoothed from node to node: neighbouring fits bend a little
// differently, and what is between must even that out. So the spline needs knots enough to follow the bend.
void KnotPlacer::add_knots_on_bend(double first, double last, double spacing) {
  const double bend = piece(knot_piece_).segment.curve.curvature();
  const double apart = std::max(spacing, knots_on_bend / std::max(bend, no_change));
  const double parts = std::min(std::ceil((last - first) / apart), most_on_bend);
  for (double i = 1; i < parts; ++i) add_knot(first + (last - first) * (i / parts));
}

// At the last two knots it is that of s, so that what is exact may go on there.
double KnotPlacer::rate_at(const Node& node, std::size_t knot, std::size_t knots) const {
  constexpr std::size_t at_rate_of_s = 2;
  if (knot + at_rate_of_s >= knots) return 1;
  const double quickening = spacing_.quickening * node.turn;
  const auto distance = [&](std::size_t i) { return i == 0 ? 0 : spacing_.knots[i - 1]; };
  return (1 + quickening * distance(knot)) / (1 + quickening * distance(knots - at_rate_of_s));
}

void KnotPlacer::add_knot(double s, double rate) {
  while (s >= piece(knot_piece_).end() && reader_.has(knot_piece_ + 1)) ++knot_piece_;
  in_stretch_ = true;
  const Piece& at = piece(knot_piece_);
  const double along = s >= at.end() ? at.length : std::min(s - at.start, at.length);
  steps_.push_back({.mark = Mark::knot, .knot = {.s = s, .piece = knot_piece_, .along = along, .rate = rate}});
}

}  // namespace passo
