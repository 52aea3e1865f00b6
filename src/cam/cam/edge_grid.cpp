#include "edge_grid.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

// Above 0 where c lies to the left of the way from a to b.
double side_of(DrawnPoint a, DrawnPoint b, DrawnPoint c) {
  return static_cast<double>(b.x.count - a.x.count) * static_cast<double>(c.y.count - a.y.count) -
         static_cast<double>(b.y.count - a.y.count) * static_cast<double>(c.x.count - a.x.count);
}

}  // namespace

EdgeGrid::EdgeGrid(const DrawnBox& box, Nanometres cell) : box_(box), cell_(static_cast<double>(cell.count)) {
  const auto width = static_cast<double>(box.most.x.count - box.least.x.count);
  const auto height = static_cast<double>(box.most.y.count - box.least.y.count);
  constexpr double most_cells = 4e6;
  cell_ = std::max({cell_, 1.0, std::sqrt(width * height / most_cells), std::max(width, height) / most_cells});
  columns_ = static_cast<std::int64_t>(width / cell_) + 1;
  rows_ = static_cast<std::int64_t>(height / cell_) + 1;
}

EdgeGrid::EdgeGrid(const DrawnBox& box, Nanometres cell, const std::vector<DrawnRing>& rings) : EdgeGrid(box, cell) {
  for (const DrawnRing& ring : rings) add(ring, 0);
  finish();
}

EdgeGrid::Cells EdgeGrid::cells_of(const DrawnBox& box, double reach) const {
  const auto cell = [this, reach](Nanometres from, Nanometres place, double sign, std::int64_t count) {
    const double off = static_cast<double>(place.count - from.count) + sign * reach;
    return static_cast<std::int64_t>(std::clamp(std::floor(off / cell_), 0.0, static_cast<double>(count - 1)));
  };
  return {cell(box_.least.x, box.least.x, -1, columns_), cell(box_.least.x, box.most.x, 1, columns_),
          cell(box_.least.y, box.least.y, -1, rows_), cell(box_.least.y, box.most.y, 1, rows_)};
}

// An edge goes through one stripe of columns in each row.
template <class Take>
void EdgeGrid::for_cells(const Edge& edge, const Take& take) const {
  const DrawnPoint low = edge.from.y <= edge.to.y ? edge.from : edge.to;
  const DrawnPoint high = edge.from.y <= edge.to.y ? edge.to : edge.from;
  const auto low_x = static_cast<double>(low.x.count);
  const auto low_y = static_cast<double>(low.y.count);
  const double dx = static_cast<double>(high.x.count) - low_x;
  const double dy = static_cast<double>(high.y.count) - low_y;
  const Cells cells = cells_of({{std::min(low.x, high.x), low.y}, {std::max(low.x, high.x), high.y}}, 1);
  for (std::int64_t row = cells.low_row; row <= cells.high_row; ++row) {
    double from = 0;
    double to = 1;
    if (dy > 0) {
      const double row_y = static_cast<double>(box_.least.y.count) + static_cast<double>(row) * cell_;
      from = std::clamp((row_y - low_y) / dy, 0.0, 1.0);
      to = std::clamp((row_y + cell_ - low_y) / dy, 0.0, 1.0);
    }
    const double a = low_x + from * dx;
    const double b = low_x + to * dx;
    const Cells stripe = cells_of(
        {{{static_cast<std::int64_t>(std::min(a, b))}, low.y}, {{static_cast<std::int64_t>(std::max(a, b))}, low.y}},
        2);
    for (std::int64_t column = stripe.low_column; column <= stripe.high_column; ++column) {
      take(static_cast<std::size_t>(row * columns_ + column));
    }
  }
}

void EdgeGrid::add(const DrawnRing& ring, std::uint32_t owner) {
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    edges_.push_back({ring[last], ring[i], owner});
  }
}

void EdgeGrid::add_line(const DrawnRing& line, std::uint32_t owner) {
  for (std::size_t i = 1; i < line.size(); ++i) edges_.push_back({line[i - 1], line[i], owner});
}

void EdgeGrid::finish() {
  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Edge& edge : edges_) {
    for_cells(edge, [this](std::size_t cell) { ++starts_[cell + 1]; });
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  entries_.resize(starts_.back());
  std::vector<std::uint32_t> filled(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    for_cells(edges_[i], [this, i, &filled](std::size_t cell) { entries_[filled[cell]++] = i; });
  }
}

EdgeGrid::Near EdgeGrid::to_edge(DrawnPoint point, const Edge& edge) {
  const auto dx = static_cast<double>(edge.to.x.count - edge.from.x.count);
  const auto dy = static_cast<double>(edge.to.y.count - edge.from.y.count);
  const auto px = static_cast<double>(point.x.count - edge.from.x.count);
  const auto py = static_cast<double>(point.y.count - edge.from.y.count);
  const double square = dx * dx + dy * dy;
  const double share = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
  const DrawnPoint at{{edge.from.x.count + std::llround(share * dx)}, {edge.from.y.count + std::llround(share * dy)}};
  return {0, std::hypot(px - share * dx, py - share * dy), at};
}

std::optional<EdgeGrid::Near> EdgeGrid::nearest(DrawnPoint point, double reach) const {
  std::optional<Near> best;
  for_near(point, point, reach, [&](std::uint32_t index) {
    Near near = to_edge(point, edges_[index]);
    near.edge = index;
    const bool is_best = near.distance_nm <= reach && (!best || near.distance_nm < best->distance_nm);
    if (is_best) best = near;
  });
  return best;
}

bool EdgeGrid::is_crossed(DrawnPoint a, DrawnPoint b) const {
  bool crossed = false;
  for_near(a, b, 0, [&](std::uint32_t index) {
    if (crossed) return;
    const Edge& edge = edges_[index];
    const bool parts_line = (side_of(a, b, edge.from) > 0) != (side_of(a, b, edge.to) > 0);
    crossed = parts_line && (side_of(edge.from, edge.to, a) > 0) != (side_of(edge.from, edge.to, b) > 0);
  });
  return crossed;
}

}  // namespace passo
