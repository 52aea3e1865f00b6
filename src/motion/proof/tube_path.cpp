#include "tube_path.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

namespace passo::proof {
namespace {

constexpr double exact_tolerance = 1e-3;  // mm: the tube of an exact path, as in PathDeviation
constexpr double turn_of_a_leg = 0.1;     // radians
constexpr double most_legs = 100'000;
// A leg is this many tolerances long, or more. Near stations say little: the motion may pass each one early or late.
constexpr double shortest_leg = 6;
constexpr double least_part_of_leg = 1e-6;
constexpr int halvings_of_leg = 50;

double distance_of(const AxisNumbers& a, const AxisNumbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (b[i] - a[i]) * (b[i] - a[i]);
  return std::sqrt(sum);
}

}  // namespace

void TubePath::add(const Segment& segment) {
  if (!segment.curve.has_length()) return;
  const ExactCurve curve(segment.curve);
  const double own = segment.tolerance.value();
  slack_ = std::max({own, last_slack_, exact_tolerance});
  last_slack_ = own;
  allow_for_turns(segment, curve);
  find_feed(segment, curve);
  if (stations_.empty()) {
    stations_.push_back({.place = piece_of(curve, 0, 0).from});
  } else if (way_ == 0) {
    Station& last = stations_.back();
    if (last.slack > 0) last.slack = std::max(last.slack, slack_);
  } else if (curve.is_line() && curve.length() > shortest_leg * slack_) {
    end_leg();  // a corner of a long line counts
  }
  const double turning = curve.is_line() ? 0 : std::min(curve.turning() / turn_of_a_leg, most_legs);
  const int count = 1 + static_cast<int>(turning);
  for (int i = 0; i < count; ++i) {
    add_piece(curve, curve.length() * i / count, curve.length() * (i + 1) / count);
  }
}

// Millimetres and degrees share one distance here. Where an axis turns, the larger of the two tolerances holds for it,
// from the last stop on: the motion may turn before the program does.
void TubePath::allow_for_turns(const Segment& segment, const ExactCurve& curve) {
  for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
    if (!curve.moves(axis) || segment.turn_tolerance <= turn_slack_) continue;
    turn_slack_ = segment.turn_tolerance;
    for (Station& station : stations_) {
      if (station.slack > 0) station.slack = std::max(station.slack, turn_slack_);
      station.around = std::max(station.around, turn_slack_);
    }
    leg_.around = std::max(leg_.around, turn_slack_);
  }
  slack_ = std::max(slack_, turn_slack_);
}

// Where a surface counts, the feed of X Y Z alone is at most the programmed one. If nothing but one surface moves, its
// feed in degrees is known.
void TubePath::find_feed(const Segment& segment, const ExactCurve& curve) {
  feed_ = std::min(segment.speed.value() * curve.feed_factor(), fastest);
  group_ = group_of(curve);
  if (!segment.surface.counts_any()) return;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis axis = axes_[i].axis;
    if (!is_rotary(axis) || (group_ >> i & 1U) == 0 || !curve.moves(axis)) continue;
    const double scale = segment.surface[axis];
    group_ = scale > 0 ? static_cast<std::uint16_t>(1U << i) : std::uint16_t{0};
    if (scale > 0) feed_ = std::min(segment.speed.value() / scale, fastest);
    return;
  }
}

// Cuts where an axis turns back, so that each axis goes one way in a piece.
void TubePath::add_piece(const ExactCurve& curve, double from, double to) {
  const double turn = turn_of(curve, from, to);
  const double least = least_part_of_leg * (to - from);
  if (turn - from > least && to - turn > least) {
    add_piece(curve, from, turn);
    add_piece(curve, turn, to);
    return;
  }
  widen(piece_of(curve, from, to));
  if (way_ > shortest_leg * slack_) end_leg();
}

// The first place where an axis turns back; `to` if there is none.
double TubePath::turn_of(const ExactCurve& curve, double from, double to) const {
  if (curve.is_line()) return to;
  for (const ProvenAxis& own : axes_) {
    const double begin = curve.at(own.axis, from).first;
    if (!(begin * curve.at(own.axis, to).first < 0)) continue;
    double low = from;
    double high = to;
    for (int i = 0; i < halvings_of_leg; ++i) {
      const double middle = (low + high) / 2;
      (curve.at(own.axis, middle).first * begin > 0 ? low : high) = middle;
    }
    if (high - from > least_part_of_leg * (to - from) && to - high > least_part_of_leg * (to - from)) return high;
  }
  return to;
}

// Between its ends a function is at most h²/8 of its largest second derivative from the straight line.
TubePath::Piece TubePath::piece_of(const ExactCurve& curve, double from, double to) const {
  Piece piece;
  const Point start = curve.place(from);
  const Point end = curve.place(to);
  const double eighth = (to - from) * (to - from) / 8;
  double bends = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis axis = axes_[i].axis;
    piece.from[i] = start[axis];
    piece.to[i] = end[axis];
    std::tie(piece.low[i], piece.high[i]) = std::minmax(piece.from[i], piece.to[i]);
    if (curve.is_line()) continue;
    const Derivatives in = curve.at(axis, from);
    const Derivatives out = curve.at(axis, to);
    const double bend = std::max(std::abs(in.second), std::abs(out.second));
    bends += bend * bend;
    const bool one_way = std::min(std::abs(in.first), std::abs(out.first)) > bend * (to - from) / 2;
    if (one_way || !curve.is_cubic()) continue;
    piece.low[i] -= eighth * bend;
    piece.high[i] += eighth * bend;
  }
  piece.bulge = eighth * std::sqrt(bends);
  piece.way = distance_of(piece.from, piece.to);
  return piece;
}

void TubePath::widen(const Piece& piece) {
  if (way_ == 0) {
    leg_ = {.low = piece.low, .high = piece.high, .feed = feed_, .group = group_};
    bulge_ = 0;
  }
  leg_.place = piece.to;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    leg_.low[i] = std::min(leg_.low[i], piece.low[i]);
    leg_.high[i] = std::max(leg_.high[i], piece.high[i]);
  }
  leg_.slack = slack_;
  leg_.around = std::max(leg_.around, slack_);
  leg_.feed = std::max(leg_.feed, feed_);
  if (leg_.group != group_) leg_.group = 0;
  way_ += piece.way + piece.bulge;
  bulge_ = std::max(bulge_, piece.bulge);
}

// A way of length L between two places that are c apart is nowhere farther from the straight line than √(L² − c²)/2.
void TubePath::end_leg() {
  if (way_ == 0) return;
  const double straight = distance_of(stations_.back().place, leg_.place);
  leg_.bulge = bulge_ + std::sqrt(std::max(way_ * way_ - straight * straight, 0.0)) / 2;
  stations_.push_back(leg_);
  way_ = 0;
}

void TubePath::rest() {
  end_leg();
  if (!stations_.empty()) stations_.back().slack = 0;
  last_slack_ = 0;
  turn_slack_ = 0;
}

void TubePath::restart() {
  if (stations_.size() > 1) stations_.erase(stations_.begin(), stations_.end() - 1);
}

// The feed counts X Y Z where any of those move, else U V W, else the angles.
std::uint16_t TubePath::group_of(const ExactCurve& curve) const {
  for (const auto& letters : {std::string_view("XYZ"), std::string_view("UVW"), std::string_view("ABC")}) {
    std::uint16_t group = 0;
    bool moves = false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (letters.find(letter_of(axes_[i].axis)) == std::string_view::npos) continue;
      group = static_cast<std::uint16_t>(group | 1U << i);
      moves = moves || curve.moves(axes_[i].axis);
    }
    if (moves) return group;
  }
  return 0;
}

}  // namespace passo::proof
