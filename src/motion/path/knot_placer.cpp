#include "knot_placer.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// The width w for a change of curvature, with the tolerance e: w² = 10 e / change.
constexpr double bend_width = 10;
// The largest width on arcs, in radii.
constexpr double arc_width = 0.4;
// Between nodes on fitted curves, in radii: the bend of the spline, a polygon, is then within a thousandth of an arc's.
// A fit turns by a radian or two, so that few knots are needed, and never more than so many.
constexpr double knots_on_bend = 0.08;
constexpr double most_on_bend = 64;
// Changes smaller than this (of a unit tangent; 1/mm) are rounding.
constexpr double no_change = 1e-9;

// Several junctions make one node under two conditions. The way from the first junction to the last is at most
// cluster_share of the node's width. Passing them as one leaves the path by at most cluster_tube of the tube.
constexpr double cluster_share = 0.5;
constexpr double cluster_tube = 0.5;

constexpr std::array knots_for_least_bending = {0.5, 1.0, 1.5};
constexpr std::array knots_for_swinging = {1.0, 2.0, 3.0, 4.5, 6.5};
// For legs that have no room for the first of those. Found by a search for the least time of stairs and polygons with
// legs of five to ten tolerances.
constexpr std::array knots_for_short_legs = {0.79, 1.29, 1.6};
// A node swings if the axis that limits the speed goes back by less than this in it.
constexpr double most_reversal = 0.7;
// With limits of jerk it swings then too, up to this change of the tangent. By trial.
constexpr double too_sharp = 1.8;
// A sharp corner to or from a slow feed (mm/s), where the feeds differ by more than this factor, does not swing: the
// slow feed is the speed there, and a swing would only be a way more at that speed. By trial.
constexpr double most_change_of_feed = 1.5;
constexpr double sharp_from = 1;
// An arc beside a corner leaves room for a swing if it turns by less (radians) in the width of the swing, and is longer
// than so many widths. Where it bends more, the arc itself is slow. By trial.
constexpr double straight_enough = 0.1;
constexpr double arc_to_swing_on = 8;
// Knots for swinging are too far apart if none has room and the nodes are this share of a width apart.
constexpr double too_far = 0.7;
// How soon the weight of the bend falls, for no reversal; how it depends on the reversal; and the most. By trial.
constexpr double weight_fall = 1.2;
constexpr double weight_fall_less = 2.2;
constexpr double most_weight_fall = 0.9;
constexpr std::array knots_for_slow_bending = {0.48, 1.0, 1.55, 2.3};
// Knots and weights of corners that swing with limits of jerk: by search for the least time of right angles, zigzags,
// polygons, random walks, reliefs and chips. The weights even out the jerk of the swings.
constexpr std::array knots_for_swinging_slowly = {1.0, 2.2, 4.35, 5.1, 8.3};
constexpr std::array change_weights_of_slow = {0.87, 0.89, 0.81, 0.65};
// A corner that is not sharp is passed so fast that the spline swings to both sides before it. If another node is
// nearer than this many widths, there is no room for two swings; if it is nearer still, there is no room for a wide
// one.
constexpr double not_sharp = 1.1;
constexpr double gentle_below = 0.6;
constexpr std::array knots_for_two_swings = {0.63, 1.51, 2.3, 3.65, 5.6, 7.7, 8.57, 11.25};
constexpr std::array change_weights_of_two_swings = {2.15, 1.68, 0.78, 0.35, 0.545, 0.515, 0.405};
constexpr double two_swings_apart_from = 20;
constexpr std::array knots_for_swinging_gently = {0.88, 1.5, 2.3, 3.2, 4.5, 6.4, 7.75, 8.8};
constexpr std::array change_weights_of_gentle = {1.75, 1.53, 0.95, 0.52, 0.46, 0.48, 0.42};
constexpr double one_swing_apart_from = 12;
constexpr std::array knots_for_company = {0.573, 2.24, 3.2, 4.4, 10.5};
constexpr std::array change_weights_of_company = {1.51, 1.32, 0.45, 0.4};
constexpr double company_apart_from = 6;
constexpr std::array knots_for_close_company = {1.02, 2.23, 4.14, 4.8, 7.15};
constexpr std::array change_weights_of_close_company = {0.97, 0.87, 1.06, 1.01};
// Where the room is a little too small for the second, third or fourth knot of such a corner, all its knots come
// closer, at most to this share. With one knot less the bend could not change slowly: the time of a staircase jumped by
// 15 % from one length of the stairs to the next. By trial; farther knots are no loss.
constexpr double closest = 0.8;
constexpr std::size_t knots_worth_it = 4;
constexpr double last_knot_reaches = 1.25;  // room of a node, in distances of its last knot
constexpr double share_of_room = 0.9;       // knots beyond this share of the room are left out

// A gap stays exact if it is longer than this many times the distance of the knots beside it. A shorter gap bends less
// as part of the stretches beside it.
constexpr double exact_from = 3;
constexpr std::size_t least_knots = 3;  // on each side of an exact piece
// A gap in which each corner has at most so many knots has more, at most a width apart.
constexpr std::size_t knots_of_short_gap = 2;
// A gap is even if both of its corners turn at least by this much, their widths differ at most by this factor, the gap
// is at most this many widths long, and the gaps beside it are longer or shorter by at most this factor. By trial: in
// other gaps, the even bending makes programs slower.
constexpr double even_turn = 0.5;
constexpr double even_widths = 1.3;
constexpr double even_length = 40;
constexpr double even_gaps = 1.5;
// Lines shorter than this (mm) have no good direction after they are cut.
constexpr double least_exact = 1e-6;

constexpr double unlimited = 1e9;

}  // namespace

// Widths for swinging are found by trial: the spline then also uses the outer side of the tube, before and after a
// corner. A swing is passed at more even speed than a corner that is rounded inside, so that s quickens less.
const KnotPlacer::Spacing KnotPlacer::slow_bending = {
    .corner_width = 4.8, .knots = knots_for_slow_bending, .quickening = 0.54};
const KnotPlacer::Spacing KnotPlacer::swinging_slowly = {.corner_width = 7,
                                                         .knots = knots_for_swinging_slowly,
                                                         .quickening = 0.31,
                                                         .sharp_from = 0.39,
                                                         .closer = &slow_bending,
                                                         .comes_closer = true,
                                                         .change_weights = change_weights_of_slow};
const KnotPlacer::Spacing KnotPlacer::gentle_close_company = {.corner_width = 7,
                                                              .knots = knots_for_close_company,
                                                              .quickening = 0.25,
                                                              .sharp_from = 0.33,
                                                              .closer = &slow_bending,
                                                              .comes_closer = true,
                                                              .change_weights = change_weights_of_close_company};
const KnotPlacer::Spacing KnotPlacer::gentle_company = {.corner_width = 7,
                                                        .knots = knots_for_company,
                                                        .quickening = 0.225,
                                                        .sharp_from = 0.39,
                                                        .closer = &slow_bending,
                                                        .apart_from = company_apart_from,
                                                        .in_company = &gentle_close_company,
                                                        .comes_closer = true,
                                                        .change_weights = change_weights_of_company};
const KnotPlacer::Spacing KnotPlacer::gentle_apart = {.corner_width = 7,
                                                      .knots = knots_for_swinging_gently,
                                                      .quickening = 0.18,
                                                      .sharp_from = 0.41,
                                                      .apart_from = one_swing_apart_from,
                                                      .in_company = &gentle_company,
                                                      .comes_closer = true,
                                                      .change_weights = change_weights_of_gentle};
const KnotPlacer::Spacing KnotPlacer::swinging_gently = {.corner_width = 7,
                                                         .knots = knots_for_two_swings,
                                                         .quickening = 0.3,
                                                         .sharp_from = 0.41,
                                                         .apart_from = two_swings_apart_from,
                                                         .in_company = &gentle_apart,
                                                         .comes_closer = true,
                                                         .change_weights = change_weights_of_two_swings};
const KnotPlacer::Spacing KnotPlacer::slow_company =
    in_company_from(gentle_company, company_apart_from, swinging_slowly);
const KnotPlacer::Spacing KnotPlacer::slow_apart = in_company_from(swinging_slowly, one_swing_apart_from, slow_company);
const KnotPlacer::Spacing KnotPlacer::swinging_twice =
    in_company_from(swinging_gently, two_swings_apart_from, slow_apart);
const KnotPlacer::Spacing KnotPlacer::inside = {.corner_width = 4, .knots = knots_for_least_bending};
const KnotPlacer::Spacing KnotPlacer::on_short_legs = {.corner_width = 4, .knots = knots_for_short_legs};
const KnotPlacer::Spacing KnotPlacer::swinging = {
    .corner_width = 7, .knots = knots_for_swinging, .closer = &on_short_legs};

KnotPlacer::KnotPlacer(RunReader& reader, Smoothness smoothness)
    : reader_(reader), bends_slowly_(smoothness == Smoothness::slow_bending) {}

// How far the axis that limits the speed before a corner and after it goes back in the corner: 0 to 1. At 1 that axis
// brakes with all it has up to the corner, and goes on so after it. A swing to the outer side would only be a way more
// for it.
double KnotPlacer::reversal(const Piece& before, const Piece& after) {
  double in = 0;
  double out = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    in = std::max(in, std::abs(before.last_tangent.values[i]));
    out = std::max(out, std::abs(after.first_tangent.values[i]));
  }
  double most = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    const double here = before.last_tangent.values[i] / in;
    const double there = after.first_tangent.values[i] / out;
    if (here * there < 0) most = std::max(most, std::min(std::abs(here), std::abs(there)));
  }
  return most;
}

bool KnotPlacer::follows_spindle(const Piece& before, const Piece& after) {
  return before.segment.lock != SpindleLock::none || after.segment.lock != SpindleLock::none;
}

// `bend`: of the piece beside the corner.
bool KnotPlacer::has_room_to_swing(const Piece& piece, const Point& bend, double width) {
  if (piece.is_line()) return true;
  const bool is_arc = piece.segment.curve.shape() == Curve::Shape::arc;
  return is_arc && width * length_of(bend) < straight_enough && piece.length > arc_to_swing_on * width;
}

const KnotPlacer::Spacing& KnotPlacer::spacing_of(const Cluster& cluster) const {
  const Piece& before = piece(cluster.first);
  const Piece& after = piece(cluster.last + 1);
  const double turn = distance(before.last_tangent, after.first_tangent);
  const bool goes_to_and_fro = reversal(before, after) >= most_reversal && (!bends_slowly_ || turn >= too_sharp);
  const auto [slower, faster] = std::minmax(before.segment.speed, after.segment.speed);
  const bool meets_slow_feed =
      turn >= sharp_from && slower <= KnotPlacer::slow_feed && faster > slower * most_change_of_feed;
  const double width = swinging.corner_width * cluster.tube / turn;
  const bool have_room =
      has_room_to_swing(before, before.last_bend, width) && has_room_to_swing(after, after.first_bend, width);
  const bool swings = have_room && !follows_spindle(before, after) && !goes_to_and_fro && !meets_slow_feed;
  if (bends_slowly_ && swings) {
    return turn < gentle_below ? swinging_gently : turn < not_sharp ? swinging_twice : swinging_slowly;
  }
  if (bends_slowly_) return slow_bending;
  return swings ? swinging : inside;
}

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

// The end of the run is also a node, of no width.
bool KnotPlacer::find_node(Node& node) {
  const std::uint64_t first = junction_;
  if (!reader_.has(first + 1)) {
    node = {.s = piece(first).end(), .width = 0, .turn = 0, .before = first, .after = first};
    all_found_ = true;
    return true;
  }
  Cluster cluster{.first = first, .last = first, .tube = std::min(piece(first).tube, piece(first + 1).tube)};
  if (goes_on(piece(first), piece(first + 1))) {  // there is nothing to round
    node = {.s = piece(first).end(), .width = 0, .turn = 0, .before = first, .after = first + 1};
  } else {
    while (cluster.last - first + 1 < most_clustered && extend(cluster)) {
    }
    node.s = (piece(first).end() + piece(cluster.last).end()) / 2;
    node.width = width_of(cluster);
    node.spacing = &spacing_of(cluster);
    node.weight_fall = weight_fall_of(cluster);
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
  if (turn > no_change) width = std::min(width, spacing_of(cluster).corner_width * cluster.tube / turn);
  if (before.is_line() && after.is_line()) return width;
  const double change = distance(before.last_bend, after.first_bend);
  if (change > no_change) width = std::min(width, std::sqrt(bend_width * cluster.tube / change));
  return std::min(width, arc_width / std::max(length_of(before.last_bend), length_of(after.first_bend)));
}

// How sharp the corner is. 0 where the feed follows the spindle: there s must stay the parameter, because the spindle
// sets s. For the same reason such a corner does not swing.
double KnotPlacer::turn_of(const Cluster& cluster) const {
  const Piece& before = piece(cluster.first);
  const Piece& after = piece(cluster.last + 1);
  return follows_spindle(before, after) ? 0 : distance(before.last_tangent, after.first_tangent);
}

// Whether tangent and second derivative go on without a change.
bool KnotPlacer::goes_on(const Piece& before, const Piece& after) {
  return distance(before.last_tangent, after.first_tangent) <= no_change &&
         distance(before.last_bend, after.first_bend) <= no_change;
}

// Takes the next junction into the cluster. False: the junction must stay out.
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

// How far the nearer one of the nodes beside a node is.
double KnotPlacer::nearest_to(const Node& node, const Node& before, const Node& after) {
  return std::min(node.s - before.s, after.s - node.s);
}

// The knots of a node that the room holds. If it is too small for the first of those for swinging, closer ones may be
// needed: where the node is alone in the room, a stretch needs knots enough; and where the other node is not close, the
// spline could not keep to the tube.
KnotPlacer::Places KnotPlacer::places_of(const Node& node, double width, double room, double nearest, bool alone) {
  const auto within = [&](const Spacing& spacing, double w) {
    Places places{.spacing = &spacing, .width = w};
    while (w > 0 && places.count < spacing.knots.size() && places.offset(places.count + 1) < share_of_room * room) {
      ++places.count;
    }
    if (spacing.comes_closer && places.count > 0 && places.count < knots_worth_it) {
      const double fitting = share_of_room * room / spacing.knots[places.count];
      if (fitting > closest * w) {
        places.width = fitting;
        ++places.count;
      }
    }
    return places;
  };
  const Spacing* fitting = node.spacing;
  while (nearest < fitting->apart_from * node.width) fitting = fitting->in_company;
  const Places places = within(*fitting, width);
  const Spacing* const closer = places.spacing->closer;
  if (places.count > 0 || closer == nullptr) return places;
  if (!alone && width < too_far * node.width) return places;
  return within(*closer, width * (closer->corner_width / places.spacing->corner_width));
}

void KnotPlacer::fill_gap() {
  const Node& from = nodes_[1];
  const Node& to = nodes_[2];
  const bool is_last = known_ == 3;
  knot_piece_ = std::max(knot_piece_, from.before);
  gap_is_even_ = is_even_gap();
  const double length = to.s - from.s;
  const double nearest = from.width > 0 ? nearest_to(from, nodes_[0], to) : 0;
  const double next_nearest = to.width > 0 ? nearest_to(to, from, nodes_[3]) : 0;
  const double width = std::min(from.width, nearest);
  const double next_width = std::min(to.width, next_nearest);

  // Each node's share of the room, and its knots in there.
  double room = 0;
  double next_room = 0;
  if (width > 0 && next_width > 0) {
    const double reach = last_knot_reaches * from.spacing->knots.back() * width;
    const double next_reach = last_knot_reaches * to.spacing->knots.back() * next_width;
    room = std::min(reach, length / 2);
    next_room = std::min(next_reach, length - room);
    room = std::min(reach, length - next_room);
  } else if (width > 0) {
    room = share_of_room * length;
  } else if (next_width > 0) {
    next_room = share_of_room * length;
  }
  const Places own = places_of(from, width, room, nearest, next_width == 0);
  const Places next = places_of(to, next_width, next_room, next_nearest, width == 0);
  const std::size_t knots = own.count + 1;  // with the node
  const std::size_t next_knots = next.count;
  const auto offset = [&](std::size_t i) { return own.offset(i); };
  const auto next_offset = [&](std::size_t i) { return next.offset(i); };

  const double first = from.s + offset(knots - 1);
  const double last = to.s - next_offset(next_knots);
  double spacing = knots > 1 ? offset(knots - 1) - offset(knots - 2) : 0;
  if (next_knots > 0) spacing = std::max(spacing, next_offset(next_knots) - next_offset(next_knots - 1));

  const Piece& between = piece(from.after);
  const bool is_whole = width == 0 && next_width == 0;
  const bool is_long = last - first > std::max(exact_from * spacing, least_exact);
  const bool has_knots = (width == 0 || knots >= least_knots) && (next_width == 0 || next_knots >= least_knots);
  const bool in_one_piece = first >= between.start && (next_width > 0 ? last < between.end() : last <= between.end());
  // A line between corners that bend slowly, and have no room for all their knots, is better bent with them.
  const auto has_all_knots = [](const Node& node, const Places& places) {
    return node.width == 0 || places.count == places.spacing->knots.size();
  };
  const bool is_bent = bends_slowly_ && between.is_line() && !(has_all_knots(from, own) && has_all_knots(to, next));
  const bool exact = is_whole || (is_long && has_knots && in_one_piece && !between.is_fitted && !is_bent);

  if (in_stretch_ || width > 0 || !exact) {
    for (std::size_t i = 0; i < knots; ++i) add_knot(from.s + offset(i), rate_at(from, own, i), own.change_weight(i));
  }
  if (exact) {
    if (in_stretch_) steps_.push_back({.mark = Mark::end_of_stretch, .knot = {}});
    in_stretch_ = false;
    gap_exact_ = {.piece = from.after,
                  .from = first - between.start,
                  .to = next_width > 0 ? last - between.start : between.length};
    steps_.push_back({.mark = Mark::exact_piece, .knot = {}});
  }
  const bool is_short = own.count <= knots_of_short_gap && next.count <= knots_of_short_gap;
  if (!exact && between.is_fitted) {
    add_knots_on_bend(first, last, spacing);
  } else if (!exact && is_short) {
    add_knots_apart(first, last, std::max(from.width, to.width));
  }
  for (std::size_t i = next_knots; i > 0; --i) {
    add_knot(to.s - next_offset(i), rate_at(to, next, i), next.change_weight(i - 1));
  }
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
  add_knots_apart(first, last, apart);
}

void KnotPlacer::add_knots_apart(double first, double last, double apart) {
  const double parts = std::min(std::ceil((last - first) / apart), most_on_bend);
  for (double i = 1; i < parts; ++i) add_knot(first + (last - first) * (i / parts));
}

// Whether the gap between the second node and the third is one of a row of similar legs between similar corners. There
// the machine passes each corner at about the same speed. An end of the run counts as any corner.
bool KnotPlacer::is_even_gap() const {
  const Node& first = nodes_[1].width > 0 ? nodes_[1] : nodes_[2];  // of the gap's corners
  const Node& last = nodes_[2].width > 0 ? nodes_[2] : nodes_[1];
  if (!(first.width > 0) || std::min(first.turn, last.turn) < even_turn) return false;
  if (bends_slowly_ && std::max(first.turn, last.turn) >= too_sharp) return false;
  if (is_slow(piece(nodes_[1].after))) return false;
  const auto [narrow, wide] = std::minmax(first.width, last.width);
  const double length = nodes_[2].s - nodes_[1].s;
  if (wide > even_widths * narrow || length > even_length * narrow) return false;
  const auto is_alike = [&](const Node& from, const Node& to) {
    if (!(from.width > 0 && to.width > 0)) return true;  // not between corners
    const double other = to.s - from.s;
    return std::max(other, length) <= even_gaps * std::min(other, length);
  };
  return is_alike(nodes_[0], nodes_[1]) && (known_ < 4 || is_alike(nodes_[2], nodes_[3]));
}

// At the last two knots it is that of s, so that what is exact may go on there.
double KnotPlacer::rate_at(const Node& node, const Places& places, std::size_t knot) {
  constexpr std::size_t at_rate_of_s = 2;
  const std::size_t knots = places.count + 1;  // with the node
  if (knot + at_rate_of_s >= knots) return 1;
  const double share = std::min(1.0, node.turn / places.spacing->sharp_from);
  const double quickening = places.spacing->quickening * share * node.turn;
  const auto distance = [&](std::size_t i) { return i == 0 ? 0 : places.spacing->knots[i - 1]; };
  return (1 + quickening * distance(knot)) / (1 + quickening * distance(knots - at_rate_of_s));
}

// Least bending alone bends most in the middle of a node, because there the spline is pushed in. The speed at which a
// gentle corner can be passed depends on the largest bend, so that even bending is better: the weight falls with the
// distance. The more an axis goes back, the more the motion slows down toward the corner, and may bend more there.
double KnotPlacer::weight_fall_of(const Cluster& cluster) const {
  if (&spacing_of(cluster) != &swinging) return 0;
  const double back = reversal(piece(cluster.first), piece(cluster.last + 1));
  return std::clamp(weight_fall * (1 - weight_fall_less * back), 0.0, most_weight_fall);
}

double KnotPlacer::weight_at(double s) const {
  double most = 0;
  for (const Node* const node : {&nodes_[1], &nodes_[2]}) {
    if (node->width > 0) most = std::max(most, 1 / (1 + node->weight_fall * std::abs(s - node->s) / node->width));
  }
  return most > 0 ? most : 1;
}

void KnotPlacer::add_knot(double s, double rate, double change_weight) {
  while (s >= piece(knot_piece_).end() && reader_.has(knot_piece_ + 1)) ++knot_piece_;
  in_stretch_ = true;
  const Piece& at = piece(knot_piece_);
  const double along = s >= at.end() ? at.length : std::min(s - at.start, at.length);
  steps_.push_back({.mark = Mark::knot,
                    .knot = {.s = s,
                             .piece = knot_piece_,
                             .along = along,
                             .rate = rate,
                             .weight = weight_at(s),
                             .change_weight = change_weight,
                             .is_even = gap_is_even_}});
}

}  // namespace passo
