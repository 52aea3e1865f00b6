#include "passo/geometry/surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo {
namespace {

constexpr std::size_t most_cells_a_side = 1024;

// The height of the triangle at a place, or Surface::nothing beside it. Upright triangles have none.
double height_at(const SurfaceTriangle& triangle, double x, double y) {
  const auto& [a, b, c] = triangle;
  const double twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (twice_area == 0) return Surface::nothing;
  const double of_b = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / twice_area;
  const double of_c = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / twice_area;
  constexpr double rounding = 1e-9;  // an edge belongs to both of its triangles
  if (of_b < -rounding || of_c < -rounding || of_b + of_c > 1 + rounding) return Surface::nothing;
  return a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z);
}

std::size_t cell_of(double offset, double size, std::size_t cells) {
  return static_cast<std::size_t>(std::clamp(offset / size, 0.0, static_cast<double>(cells - 1)));
}

}  // namespace

Surface::Surface(std::vector<SurfaceTriangle> triangles, std::function<double(double x, double y)> height)
    : triangles_(std::move(triangles)), height_(std::move(height)) {
  if (triangles_.empty()) return;
  low_ = high_ = triangles_.front().front();
  for (const SurfaceTriangle& triangle : triangles_) {
    for (const SurfacePoint& corner : triangle) {
      low_ = {std::min(low_.x, corner.x), std::min(low_.y, corner.y), std::min(low_.z, corner.z)};
      high_ = {std::max(high_.x, corner.x), std::max(high_.y, corner.y), std::max(high_.z, corner.z)};
    }
  }
  choose_cells();
  sort_into_cells();
  add_levels();
}

// About one triangle a cell.
void Surface::choose_cells() {
  const double width = high_.x - low_.x;
  const double depth = high_.y - low_.y;
  const double longest = std::max({width, depth, 1e-6});
  const double wanted =
      std::sqrt(std::max(width * depth, longest * longest * 1e-3) / static_cast<double>(triangles_.size()));
  const double size = std::max(wanted, longest / static_cast<double>(most_cells_a_side));
  const auto cells = [&](double length) { return static_cast<std::size_t>(length / size) + 1; };
  levels_.push_back({.size = size, .across = cells(width), .up = cells(depth)});
}

Surface::CellRange Surface::cells_under(const SurfaceTriangle& triangle) const {
  const Level& level = levels_.front();
  const auto [left, right] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
  const auto [front, back] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  return {.first_x = cell_of(left - low_.x, level.size, level.across),
          .last_x = cell_of(right - low_.x, level.size, level.across),
          .first_y = cell_of(front - low_.y, level.size, level.up),
          .last_y = cell_of(back - low_.y, level.size, level.up)};
}

// Counts first, then fills: one list for all cells.
void Surface::sort_into_cells() {
  Level& level = levels_.front();
  level.highest.assign(level.across * level.up, -std::numeric_limits<float>::infinity());
  begins_.assign(level.across * level.up + 1, 0);
  const auto for_each_cell = [&](std::size_t triangle, const auto& act) {
    const CellRange cells = cells_under(triangles_[triangle]);
    for (std::size_t y = cells.first_y; y <= cells.last_y; ++y) {
      for (std::size_t x = cells.first_x; x <= cells.last_x; ++x) act(y * level.across + x);
    }
  };
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for_each_cell(t, [&](std::size_t cell) { ++begins_[cell + 1]; });
  }
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  members_.resize(begins_.back());
  std::vector<std::uint32_t> next = begins_;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const SurfaceTriangle& triangle = triangles_[t];
    const double highest = std::max({triangle[0].z, triangle[1].z, triangle[2].z});
    const float rounded_up = std::nextafter(static_cast<float>(highest), std::numeric_limits<float>::infinity());
    for_each_cell(t, [&](std::size_t cell) {
      members_[next[cell]++] = static_cast<std::uint32_t>(t);
      level.highest[cell] = std::max(level.highest[cell], rounded_up);
    });
  }
}

void Surface::add_levels() {
  while (levels_.back().across > 1 || levels_.back().up > 1) {
    const Level& fine = levels_.back();
    Level coarse{.size = fine.size * 2, .across = (fine.across + 1) / 2, .up = (fine.up + 1) / 2};
    coarse.highest.assign(coarse.across * coarse.up, -std::numeric_limits<float>::infinity());
    for (std::size_t y = 0; y < fine.up; ++y) {
      for (std::size_t x = 0; x < fine.across; ++x) {
        float& highest = coarse.highest[y / 2 * coarse.across + x / 2];
        highest = std::max(highest, fine.highest[y * fine.across + x]);
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

double Surface::top(double x, double y) const {
  if (triangles_.empty() || x < low_.x || x > high_.x || y < low_.y || y > high_.y) return nothing;
  if (height_) return height_(x, y);
  const Level& level = levels_.front();
  const std::size_t cell =
      cell_of(y - low_.y, level.size, level.up) * level.across + cell_of(x - low_.x, level.size, level.across);
  double highest = nothing;
  for (std::uint32_t i = begins_[cell]; i < begins_[cell + 1]; ++i) {
    highest = std::max(highest, height_at(triangles_[members_[i]], x, y));
  }
  return highest;
}

// The point stays within the nine cells around it for as long as its way is not longer than a cell.
double Surface::clearance_at(const Level& level, double x, double y, double z) {
  const double column = std::floor(x / level.size);
  const double row = std::floor(y / level.size);
  double highest = nothing;
  for (double up = row - 1; up <= row + 1; ++up) {
    if (up < 0 || up >= static_cast<double>(level.up)) continue;
    for (double across = column - 1; across <= column + 1; ++across) {
      if (across < 0 || across >= static_cast<double>(level.across)) continue;
      const std::size_t cell = static_cast<std::size_t>(up) * level.across + static_cast<std::size_t>(across);
      highest = std::max(highest, static_cast<double>(level.highest[cell]));
    }
  }
  return std::min(level.size, z - highest);
}

double Surface::clearance(const SurfacePoint& point) const {
  const SurfacePoint& p = point;
  if (triangles_.empty()) return std::numeric_limits<double>::infinity();
  double most = std::max({0.0, p.z - high_.z, low_.x - p.x, p.x - high_.x, low_.y - p.y, p.y - high_.y});
  for (const Level& level : levels_) most = std::max(most, clearance_at(level, p.x - low_.x, p.y - low_.y, p.z));
  return most;
}

}  // namespace passo
