#include "wire_match.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

constexpr double corner_of_wire = 30 * std::numbers::pi / 180;

using WireRow = std::vector<FlatVector>;

double wire_distance(FlatVector a, FlatVector b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

WireRow row_of(const WireProfile& profile, Nanometres tolerance) {
  DrawnRing ring = chords_of_path(profile.points, profile.is_closed, tolerance);
  if (profile.is_closed && ring.size() > 2) {
    if (area_mm2(ring) < 0) std::ranges::reverse(ring);
    const auto start = std::ranges::max_element(ring, {}, [](DrawnPoint at) { return at.x; });
    std::rotate(ring.begin(), start, ring.end());
    ring.push_back(ring.front());
  }
  WireRow row;
  for (const DrawnPoint& point : ring) {
    const FlatVector at{static_cast<double>(point.x.count), static_cast<double>(point.y.count)};
    if (row.empty() || wire_distance(row.back(), at) > 0) row.push_back(at);
  }
  return row;
}

double turn_at(const WireRow& row, std::size_t i) {
  const FlatVector in{row[i].x - row[i - 1].x, row[i].y - row[i - 1].y};
  const FlatVector out{row[i + 1].x - row[i].x, row[i + 1].y - row[i].y};
  return std::atan2(cross(in, out), dot(in, out));
}

std::vector<std::size_t> corners_of(const WireRow& row) {
  std::vector<std::size_t> corners = {0};
  for (std::size_t i = 1; i + 1 < row.size(); ++i) {
    if (std::abs(turn_at(row, i)) > corner_of_wire) corners.push_back(i);
  }
  corners.push_back(row.size() - 1);
  return corners;
}

// The two ends and, between them, the place of least X.
std::vector<std::size_t> ends_and_nose(const WireRow& row) {
  const auto nose = std::ranges::min_element(row, {}, [](FlatVector at) { return at.x; });
  const auto index = static_cast<std::size_t>(nose - row.begin());
  if (index == 0 || index + 1 == row.size()) return {0, row.size() - 1};
  return {0, index, row.size() - 1};
}

double way_of(const WireRow& row, std::size_t from, std::size_t to) {
  double way = 0;
  for (std::size_t i = from; i < to; ++i) way += wire_distance(row[i], row[i + 1]);
  return way;
}

// How far along each place is, as shares of the way from one mark to the next.
std::vector<double> shares_of(const WireRow& row, std::size_t from, std::size_t to) {
  std::vector<double> shares = {0};
  for (std::size_t i = from; i < to; ++i) shares.push_back(shares.back() + wire_distance(row[i], row[i + 1]));
  const double whole = shares.back();
  for (double& share : shares) share /= whole;
  shares.back() = 1;
  return shares;
}

FlatVector place_at(const WireRow& row, std::size_t from, const std::vector<double>& shares, double share) {
  const auto after = std::ranges::upper_bound(shares, share);
  const std::size_t i = std::min(static_cast<std::size_t>(after - shares.begin()), shares.size() - 1);
  const double part = (share - shares[i - 1]) / (shares[i] - shares[i - 1]);
  const FlatVector a = row[from + i - 1];
  const FlatVector b = row[from + i];
  return {a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part};
}

}  // namespace

MatchedRows match_rows(const WireProfile& left, const WireProfile& right, Nanometres tolerance) {
  const WireRow a = row_of(left, tolerance);
  const WireRow b = row_of(right, tolerance);
  MatchedRows rows;
  if (a.size() < 2 || b.size() < 2) return rows;
  std::vector<std::size_t> marks_a = corners_of(a);
  std::vector<std::size_t> marks_b = corners_of(b);
  if (marks_a.size() != marks_b.size()) {
    marks_a = ends_and_nose(a);
    marks_b = ends_and_nose(b);
  }
  if (marks_a.size() != marks_b.size()) {
    marks_a = {0, a.size() - 1};
    marks_b = {0, b.size() - 1};
  }
  rows.left = {a.front()};
  rows.right = {b.front()};
  rows.marks = {0};
  for (std::size_t k = 0; k + 1 < marks_a.size(); ++k) {
    const std::vector<double> of_a = shares_of(a, marks_a[k], marks_a[k + 1]);
    const std::vector<double> of_b = shares_of(b, marks_b[k], marks_b[k + 1]);
    std::vector<double> all = of_a;
    all.insert(all.end(), of_b.begin(), of_b.end());
    std::ranges::sort(all);
    double done = 0;
    // Places nearer to each other than the tolerance are one.
    const double longer = std::max(way_of(a, marks_a[k], marks_a[k + 1]), way_of(b, marks_b[k], marks_b[k + 1]));
    const double least = std::clamp(static_cast<double>(tolerance.count) / longer, 1e-7, 0.01);
    for (const double share : all) {
      if (share - done < least || (share < 1 && 1 - share < least)) continue;
      rows.left.push_back(place_at(a, marks_a[k], of_a, share));
      rows.right.push_back(place_at(b, marks_b[k], of_b, share));
      done = share;
    }
    rows.marks.push_back(rows.left.size() - 1);
  }
  return rows;
}

}  // namespace passo
