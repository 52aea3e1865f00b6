#include "body_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "parallel_rows.hpp"

namespace passo {
namespace {

constexpr std::size_t band_rows = 64;  // cells; a band of a thousand columns stays in the cache
constexpr double slack = 1e-7;         // of a cell: a point so near a grid line belongs to both sides
constexpr float nothing = -std::numeric_limits<float>::infinity();

// The rows of cells `first` to `first + count - 1`, and the nodes around them.
class GridBand {
 public:
  GridBand(const BodyCover& cover, std::size_t first)
      : cover_(cover),
        first_(first),
        count_(std::min(band_rows, cover.rows - 1 - first)),
        low_(static_cast<double>(first)),
        high_(static_cast<double>(first + count_)),
        heights_((count_ + 1) * cover.columns, cover.floor),
        excess_(count_ * (cover.columns - 1), nothing),
        tops_(excess_.size(), nothing) {}

  void put_nodes();
  void put_nodes(const SurfaceTriangle& face);
  void put_edges(const SurfaceTriangle& face);
  // The heights of the nodes, raised where it is necessary.
  std::vector<float> take_raised();

 private:
  void put_edge(const SurfacePoint& a, const SurfacePoint& b);
  void put_point(double x, double y, double z);
  void put_in_cell(std::size_t column, std::size_t row, double x, double y, double z);

  const BodyCover& cover_;
  std::size_t first_;
  std::size_t count_;
  double low_;
  double high_;
  std::vector<float> heights_;
  std::vector<float> excess_;  // for each cell: how far the body rises above the patch
  std::vector<float> tops_;    // for each cell: the highest point of an edge
};

void GridBand::put_nodes() {
  for (std::size_t row = 0; row <= count_; ++row) {
    float* const heights = &heights_[row * cover_.columns];
    for (std::size_t column = 0; column < cover_.columns; ++column) {
      heights[column] =
          static_cast<float>(cover_.at_node(static_cast<double>(column), static_cast<double>(first_ + row)));
    }
  }
}

// Row by row, between the two edges that the row crosses. What a node on an edge misses by rounding, put_edges() finds.
void GridBand::put_nodes(const SurfaceTriangle& face) {
  const auto [lowest, highest] = std::minmax({face[0].y, face[1].y, face[2].y});
  const double begin = std::max(std::ceil(lowest), low_);
  const double end = std::min(std::floor(highest), high_);
  for (double y = begin; y <= end; ++y) {
    SurfacePoint left{std::numeric_limits<double>::infinity(), 0, 0};
    SurfacePoint right{-left.x, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const SurfacePoint& a = face[i];
      const SurfacePoint& b = face[(i + 1) % 3];
      if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y || a.y == b.y) continue;
      const double share = (y - a.y) / (b.y - a.y);
      const SurfacePoint here{a.x + (b.x - a.x) * share, y, a.z + (b.z - a.z) * share};
      if (here.x < left.x) left = here;
      if (here.x > right.x) right = here;
    }
    const double first = std::max(0.0, std::ceil(left.x));
    const double last = std::min(static_cast<double>(cover_.columns - 1), std::floor(right.x));
    if (!(first <= last)) continue;
    const double slope = right.x > left.x ? (right.z - left.z) / (right.x - left.x) : 0;
    float* const heights = &heights_[static_cast<std::size_t>(y - low_) * cover_.columns];
    double z = left.z + (first - left.x) * slope;
    for (auto column = static_cast<std::size_t>(first); column <= static_cast<std::size_t>(last); ++column) {
      heights[column] = std::max(heights[column], static_cast<float>(z));
      z += slope;
    }
  }
}

void GridBand::put_edges(const SurfaceTriangle& face) {
  const auto [lowest, highest] = std::minmax({face[0].y, face[1].y, face[2].y});
  if (lowest > high_ + slack || highest < low_ - slack) return;
  for (std::size_t i = 0; i < 3; ++i) put_edge(face[i], face[(i + 1) % 3]);
}

void GridBand::put_edge(const SurfacePoint& a, const SurfacePoint& b) {
  if (cover_.has_straight_edges_only && a.x != b.x && a.y != b.y) return;
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double dz = b.z - a.z;
  const double length = std::hypot(dx, dy);
  const auto put = [&](double x, double y, double z) {
    if (cover_.at_edge) z = cover_.at_edge({x, y, z}, length > 0 ? dy / length : 0, length > 0 ? -dx / length : 0);
    put_point(x, y, z);
  };
  put(a.x, a.y, a.z);
  put(b.x, b.y, b.z);
  if (dy != 0) {
    const double begin = std::max(std::ceil(std::min(a.y, b.y)), low_);
    const double end = std::min(std::max(a.y, b.y), high_);
    for (double y = begin; y <= end; ++y) {
      const double share = (y - a.y) / dy;
      put(a.x + dx * share, y, a.z + dz * share);
    }
  }
  if (dx == 0) return;
  // Only where the edge is within the band.
  double from = std::min(a.x, b.x);
  double to = std::max(a.x, b.x);
  if (dy != 0) {
    const double at_low = a.x + dx * std::clamp((low_ - slack - a.y) / dy, 0.0, 1.0);
    const double at_high = a.x + dx * std::clamp((high_ + slack - a.y) / dy, 0.0, 1.0);
    from = std::max(from, std::min(at_low, at_high));
    to = std::min(to, std::max(at_low, at_high));
  }
  for (double x = std::ceil(from); x <= to; ++x) {
    const double share = (x - a.x) / dx;
    put(x, a.y + dy * share, a.z + dz * share);
  }
}

void GridBand::put_point(double x, double y, double z) {
  if (y < low_ - slack || y > high_ + slack) return;
  const auto cell = [](double at, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t left = cell(x - slack, cover_.columns - 1);
  const std::size_t right = cell(x + slack, cover_.columns - 1);
  const std::size_t lower = cell(y - low_ - slack, count_);
  const std::size_t upper = cell(y - low_ + slack, count_);
  for (std::size_t row = lower; row <= upper; ++row) {
    for (std::size_t column = left; column <= right; ++column) put_in_cell(column, row, x, y, z);
  }
}

void GridBand::put_in_cell(std::size_t column, std::size_t row, double x, double y, double z) {
  const float* const low = &heights_[row * cover_.columns + column];
  const float* const high = low + cover_.columns;
  const auto u = static_cast<float>(std::clamp(x - static_cast<double>(column), 0.0, 1.0));
  const auto v = static_cast<float>(std::clamp(y - low_ - static_cast<double>(row), 0.0, 1.0));
  const float patch = (1 - v) * ((1 - u) * low[0] + u * low[1]) + v * ((1 - u) * high[0] + u * high[1]);
  const std::size_t cell = row * (cover_.columns - 1) + column;
  excess_[cell] = std::max(excess_[cell], static_cast<float>(z) - patch);
  tops_[cell] = std::max(tops_[cell], static_cast<float>(z));
}

std::vector<float> GridBand::take_raised() {
  std::vector<float> raised = heights_;
  const std::size_t columns = cover_.columns;
  // Between the points that were looked at, a twisted patch hangs through by at most a quarter of its twist.
  for (std::size_t row = 0; row < count_; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const std::size_t cell = row * (columns - 1) + column;
      if (excess_[cell] == nothing) continue;
      const std::size_t corners[] = {row * columns + column, row * columns + column + 1, (row + 1) * columns + column,
                                     (row + 1) * columns + column + 1};
      const auto height = [&](std::size_t corner) { return heights_[corners[corner]]; };
      const float twist = std::abs(height(0) - height(1) - height(2) + height(3));
      const float excess = excess_[cell] + twist / 4;
      constexpr float rounding = 1e-5F;  // mm
      if (excess <= rounding) continue;
      const float lowest = std::min(std::min(height(0), height(1)), std::min(height(2), height(3)));
      const float top = tops_[cell];
      constexpr float small = 0.25F;
      const bool is_small = excess <= small * std::min(static_cast<float>(cover_.pitch), top - lowest);
      for (const std::size_t corner : corners) {
        raised[corner] = std::max(raised[corner], is_small ? heights_[corner] + excess : top);
      }
    }
  }
  return raised;
}

// Which faces each band meets: one list for all bands.
class FacesOfBands {
 public:
  FacesOfBands(const std::vector<SurfaceTriangle>& faces, std::size_t bands) : begins_(bands + 1, 0) {
    const auto for_each_band = [&](std::size_t face, const auto& act) {
      const auto [lowest, highest] = std::minmax({faces[face][0].y, faces[face][1].y, faces[face][2].y});
      const auto band = [&](double y) {
        return static_cast<std::size_t>(std::clamp(y / band_rows, 0.0, static_cast<double>(bands - 1)));
      };
      for (std::size_t i = band(lowest - 1); i <= band(highest + 1); ++i) act(i);
    };
    for (std::size_t face = 0; face < faces.size(); ++face) {
      for_each_band(face, [&](std::size_t band) { ++begins_[band + 1]; });
    }
    for (std::size_t band = 0; band < bands; ++band) begins_[band + 1] += begins_[band];
    members_.resize(begins_.back());
    std::vector<std::size_t> next = begins_;
    for (std::size_t face = 0; face < faces.size(); ++face) {
      for_each_band(face, [&](std::size_t band) { members_[next[band]++] = static_cast<std::uint32_t>(face); });
    }
  }

  template <class Act>
  void each(std::size_t band, const Act& act) const {
    for (std::size_t i = begins_[band]; i < begins_[band + 1]; ++i) act(members_[i]);
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> members_;
};

}  // namespace

std::vector<float> cover_body(const std::vector<SurfaceTriangle>& faces, const BodyCover& cover) {
  const std::size_t bands = (cover.rows - 1 + band_rows - 1) / band_rows;
  const FacesOfBands of_band(faces, bands);
  std::vector<float> all(cover.columns * cover.rows);
  std::vector<std::vector<float>> firsts(bands);  // the first row of each band, which is the last of the one before
  for_each_row(bands, cover.threads, [&](std::size_t index, std::size_t) {
    const std::size_t first = index * band_rows;
    GridBand band(cover, first);
    if (cover.at_node) {
      band.put_nodes();
    } else {
      of_band.each(index, [&](std::size_t face) { band.put_nodes(faces[face]); });
    }
    of_band.each(index, [&](std::size_t face) { band.put_edges(faces[face]); });
    const std::vector<float> raised = band.take_raised();
    const auto columns = static_cast<std::ptrdiff_t>(cover.columns);
    firsts[index].assign(raised.begin(), raised.begin() + columns);
    std::copy(raised.begin() + columns, raised.end(), &all[(first + 1) * cover.columns]);
  });
  std::copy(firsts[0].begin(), firsts[0].end(), all.begin());
  for (std::size_t band = 1; band < bands; ++band) {
    float* const row = &all[band * band_rows * cover.columns];
    for (std::size_t i = 0; i < cover.columns; ++i) row[i] = std::max(row[i], firsts[band][i]);
  }
  return all;
}

}  // namespace passo
