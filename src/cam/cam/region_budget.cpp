#include "region_budget.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

struct Edge {
  double x1, y1, x2, y2;  // y1 <= y2
};

double side_of(const Edge& edge, double x, double y) {
  return (edge.x2 - edge.x1) * (y - edge.y1) - (edge.y2 - edge.y1) * (x - edge.x1);
}

bool cross(const Edge& a, const Edge& b) {
  return side_of(a, b.x1, b.y1) * side_of(a, b.x2, b.y2) < 0 && side_of(b, a.x1, a.y1) * side_of(b, a.x2, a.y2) < 0;
}

// Squares over all edges, each with the edges that go through it.
class EdgeSquares {
 public:
  explicit EdgeSquares(const std::vector<Edge>& edges) {
    double most_x = -1e300;
    double most_y = -1e300;
    for (const Edge& edge : edges) {
      x_ = std::min({x_, edge.x1, edge.x2});
      y_ = std::min(y_, edge.y1);
      most_x = std::max({most_x, edge.x1, edge.x2});
      most_y = std::max(most_y, edge.y2);
    }
    side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(edges.size()))), 1, 1024);
    width_ = std::max(1.0, (most_x - x_) / static_cast<double>(side_));
    height_ = std::max(1.0, (most_y - y_) / static_cast<double>(side_));
    squares_.resize(side_ * side_);
  }

  void add(const Edge& edge, std::uint32_t index) {
    const double slope = edge.y2 > edge.y1 ? (edge.x2 - edge.x1) / (edge.y2 - edge.y1) : 0;
    const std::size_t last = row_of(edge.y2);
    for (std::size_t row = row_of(edge.y1); row <= last; ++row) {
      const double low = std::max(edge.y1, y_ + height_ * static_cast<double>(row));
      const double high = std::min(edge.y2, y_ + height_ * static_cast<double>(row + 1));
      double from = edge.y2 > edge.y1 ? edge.x1 + slope * (low - edge.y1) : edge.x1;
      double to = edge.y2 > edge.y1 ? edge.x1 + slope * (high - edge.y1) : edge.x2;
      if (from > to) std::swap(from, to);
      for (std::size_t column = column_of(from); column <= column_of(to); ++column) {
        squares_[row * side_ + column].push_back(index);
        ++entries_;
      }
    }
  }

  std::size_t entries() const { return entries_; }
  const std::vector<std::vector<std::uint32_t>>& all() const { return squares_; }

 private:
  std::size_t column_of(double x) const { return index_of((x - x_) / width_); }
  std::size_t row_of(double y) const { return index_of((y - y_) / height_); }
  std::size_t index_of(double place) const {
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(side_ - 1)));
  }

  double x_ = 1e300;
  double y_ = 1e300;
  double width_ = 1;
  double height_ = 1;
  std::size_t side_ = 1;
  std::size_t entries_ = 0;
  std::vector<std::vector<std::uint32_t>> squares_;
};

std::vector<Edge> edges_of(const std::vector<const DrawnRing*>& rings) {
  std::vector<Edge> edges;
  for (const DrawnRing* const ring : rings) {
    for (std::size_t i = 0, last = ring->size() - 1; i < ring->size(); last = i++) {
      Edge edge{static_cast<double>((*ring)[last].x.count), static_cast<double>((*ring)[last].y.count),
                static_cast<double>((*ring)[i].x.count), static_cast<double>((*ring)[i].y.count)};
      if (edge.y1 > edge.y2) edge = {edge.x2, edge.y2, edge.x1, edge.y1};
      edges.push_back(edge);
    }
  }
  return edges;
}

// A sweep stops at each corner's Y and passes all edges that are there.
std::size_t passed_by_sweep(const std::vector<Edge>& edges) {
  std::vector<double> stops;
  for (const Edge& edge : edges) stops.push_back(edge.y1);
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  std::size_t passed = 0;
  for (const Edge& edge : edges) {
    const auto first = std::lower_bound(stops.begin(), stops.end(), edge.y1);
    passed += static_cast<std::size_t>(std::lower_bound(first, stops.end(), edge.y2) - first);
  }
  return passed;
}

}  // namespace

bool RegionBudget::spend(std::size_t cost, std::size_t& left) {
  if (cost > left) return false;
  left -= cost;
  return true;
}

bool RegionBudget::affords(const std::vector<const DrawnRing*>& rings) {
  std::size_t points = 0;
  for (const DrawnRing* const ring : rings) points += ring->size();
  constexpr std::size_t of_each = 3'000;  // to begin with, whatever the rings are
  if (!spend(of_each, comparisons_)) return false;
  constexpr std::size_t few = 64;  // their crossings cannot be many
  if (points <= few) return spend(points, comparisons_);
  const std::vector<Edge> edges = edges_of(rings);
  if (!spend(passed_by_sweep(edges), passed_)) return false;
  EdgeSquares squares(edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    squares.add(edges[i], static_cast<std::uint32_t>(i));
    if (squares.entries() > comparisons_) return false;
  }
  for (const std::vector<std::uint32_t>& square : squares.all()) {
    if (!spend(square.size() * square.size() / 2, comparisons_)) return false;
    for (std::size_t i = 0; i < square.size(); ++i) {
      for (std::size_t k = i + 1; k < square.size(); ++k) {
        if (cross(edges[square[i]], edges[square[k]]) && !spend(1, crossings_)) return false;
      }
    }
  }
  return true;
}

bool RegionBudget::affords(const std::vector<Region>& regions) {
  std::vector<const DrawnRing*> rings;
  for (const Region& region : regions) {
    for (const DrawnRing& ring : region.rings) rings.push_back(&ring);
  }
  return affords(rings);
}

bool RegionBudget::affords(const std::vector<DrawnRing>& rings) {
  std::vector<const DrawnRing*> pointers;
  for (const DrawnRing& ring : rings) pointers.push_back(&ring);
  return affords(pointers);
}

}  // namespace passo
