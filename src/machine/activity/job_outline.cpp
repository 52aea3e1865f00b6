#include "passo/activity/job_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

namespace passo {
namespace {

using Spot = JobOutline::Spot;

constexpr std::size_t most_spots = 8192;
constexpr std::size_t most_corners = 1024;
constexpr int directions = 512;
constexpr double chord_angle = std::numbers::pi / 60;  // of arcs
constexpr int most_chords = 120;                       // a full turn
constexpr int cubic_chords = 24;

// Above 0: b lies to the right of the line from a to c.
double turn(const Spot& a, const Spot& b, const Spot& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Appends one side of the hull, without its last corner. Andrew's monotone chain, 1979.
template <class Iterator>
void add_side(Iterator first, Iterator last, std::vector<Spot>& corners) {
  const std::size_t base = corners.size();
  for (; first != last; ++first) {
    while (corners.size() >= base + 2 && turn(corners[corners.size() - 2], corners.back(), *first) <= 0) {
      corners.pop_back();
    }
    corners.push_back(*first);
  }
  corners.pop_back();
}

std::vector<Spot> hull_of_spots(std::vector<Spot> spots) {
  std::ranges::sort(spots);
  spots.erase(std::unique(spots.begin(), spots.end()), spots.end());
  if (spots.size() < 2) return spots;
  std::vector<Spot> corners;
  add_side(spots.begin(), spots.end(), corners);
  add_side(spots.rbegin(), spots.rend(), corners);
  return corners;
}

int chords_of(const Curve& curve) {
  if (curve.shape() == Curve::Shape::line) return 1;
  if (curve.shape() == Curve::Shape::cubic) return cubic_chords;
  return std::clamp(static_cast<int>(std::ceil(std::abs(curve.arc_data().sweep) / chord_angle)), 1, most_chords);
}

}  // namespace

void JobOutline::add(const PathItem& item) {
  const auto* const segment = std::get_if<Segment>(&item);
  if (segment == nullptr) return;
  const Curve& curve = segment->curve;
  const Box box = curve.extents();
  if (segment->rapid) {
    rapid_top_ = std::max(rapid_top_, curve.end()[Axis::z]);
    return;
  }
  top_ = std::max({top_, rapid_top_, box.high[Axis::z]});
  rapid_top_ = top_;
  work_zero_ = segment->work_zero;
  const Axis plane[] = {Axis::x, Axis::y};
  for (std::size_t i = 0; i < low_.size(); ++i) {
    low_[i] = std::min(low_[i], box.low[plane[i]]);
    high_[i] = std::max(high_[i], box.high[plane[i]]);
  }
  const int chords = chords_of(curve);
  add_spot(curve.start());
  for (int i = 1; i < chords; ++i) add_spot(curve.at(curve.length() * (static_cast<double>(i) / chords)));
  add_spot(curve.end());
}

void JobOutline::add_spot(const Point& place) {
  const Spot spot{place[Axis::x], place[Axis::y]};
  if (!spots_.empty() && spots_.back() == spot) return;
  spots_.push_back(spot);
  if (spots_.size() >= most_spots) shrink();
}

void JobOutline::shrink() {
  std::vector<Spot> corners = hull_of_spots(std::move(spots_));
  if (corners.size() <= most_corners) {
    spots_ = std::move(corners);
    return;
  }
  spots_.clear();
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    const auto outwards = [x = std::cos(angle), y = std::sin(angle)](const Spot& a) { return x * a[0] + y * a[1]; };
    spots_.push_back(*std::ranges::max_element(corners, {}, outwards));
  }
}

std::vector<Spot> JobOutline::hull() const {
  return hull_of_spots(spots_);
}

}  // namespace passo
