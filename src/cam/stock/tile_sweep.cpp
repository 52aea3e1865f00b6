#include "tile_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "swept_profile.hpp"

namespace passo {
namespace {

// A drop below this is rounding.
constexpr float least_drop = 1e-5F;
// Ways shorter than this in X and Y go straight down.
constexpr double shortest_level_way = 1e-7;

constexpr std::size_t lanes = 8;

constexpr std::array<float, tile_size> make_indices() {
  std::array<float, tile_size> indices{};
  for (std::size_t i = 0; i < tile_size; ++i) indices[i] = static_cast<float>(i);
  return indices;
}
constexpr std::array<float, tile_size> indices = make_indices();

// The sweep as the tile sees it: lengths from the middle of its first cell. The way begins at s = `first`, ends at
// s = `last`, and has s = 0 next to the tile, so that floats are enough.
struct LocalSweep {
  double high_x = 0;
  double high_y = 0;
  double low_x = 0;
  double low_y = 0;
  double along_x = 1;  // of length 1
  double along_y = 0;
  double x = 0;  // at s = 0
  double y = 0;
  float first = 0;
  float last = 0;
  float z = 0;      // at s = 0, from the stock's top
  float slope = 0;  // how far z falls for each mm of s
  double rim = 0;
};

LocalSweep local_sweep(const HeightField& field, const Tile& tile, const Sweep& sweep, double rim) {
  LocalSweep local;
  const double x0 = field.x_of(tile.column);
  const double y0 = field.y_of(tile.row);
  local.high_x = sweep.high.x - x0;
  local.high_y = sweep.high.y - y0;
  local.low_x = sweep.low.x - x0;
  local.low_y = sweep.low.y - y0;
  local.rim = rim;
  const double way_x = local.low_x - local.high_x;
  const double way_y = local.low_y - local.high_y;
  const double length = std::sqrt(way_x * way_x + way_y * way_y);
  if (length < shortest_level_way) {
    local.x = local.low_x;
    local.y = local.low_y;
    local.z = static_cast<float>(sweep.low.z - field.top());
    return local;
  }
  local.along_x = way_x / length;
  local.along_y = way_y / length;
  const double middle_x = 0.5 * static_cast<double>(tile.columns - 1) * field.cell();
  const double middle_y = 0.5 * static_cast<double>(tile.rows - 1) * field.cell();
  const double nearest = (middle_x - local.high_x) * local.along_x + (middle_y - local.high_y) * local.along_y;
  const double zero = std::clamp(nearest, 0.0, length);
  const double slope = (sweep.high.z - sweep.low.z) / length;
  local.x = local.high_x + zero * local.along_x;
  local.y = local.high_y + zero * local.along_y;
  local.first = static_cast<float>(-zero);
  local.last = static_cast<float>(length - zero);
  local.z = static_cast<float>(sweep.high.z - field.top() - slope * zero);
  local.slope = static_cast<float>(slope);
  return local;
}

// The columns of a row that the sweep may touch, with a little more at both ends. Seen from above, the sweep is two
// discs and the strip between them.
std::pair<std::size_t, std::size_t> columns_of(const LocalSweep& sweep, double y, double cell, std::size_t columns) {
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  const auto widen = [&](double low, double high) {
    from = std::min(from, low);
    to = std::max(to, high);
  };
  const auto add_disc = [&](double disc_x, double disc_y) {
    const double square = sweep.rim * sweep.rim - (y - disc_y) * (y - disc_y);
    if (square < 0) return;
    const double half = std::sqrt(square);
    widen(disc_x - half, disc_x + half);
  };
  add_disc(sweep.high_x, sweep.high_y);
  add_disc(sweep.low_x, sweep.low_y);
  for (const double side : {sweep.rim, -sweep.rim}) {
    const double out_y = side * sweep.along_x;
    const double rise = sweep.low_y - sweep.high_y;
    const double share = (y - out_y - sweep.high_y) / rise;
    if (!(share >= 0 && share <= 1)) continue;
    const double x = sweep.high_x - side * sweep.along_y + share * (sweep.low_x - sweep.high_x);
    widen(x, x);
  }
  constexpr double more = 1e-3;
  const double first = std::max(0.0, std::ceil(from / cell - more));
  const double last = std::min(static_cast<double>(columns) - 1, std::floor(to / cell + more));
  if (!(first <= last)) return {0, 0};
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last) + 1};
}

// What the cells of a row lose.
struct RowDrops {
  alignas(32) std::array<float, tile_size> values;
  std::size_t count = 0;  // a multiple of `lanes`; the rest is 0
};

template <bool cuts, class Profile, class Cells>
void sweep_row(const LocalSweep& sweep, const Profile& of_tool, float floor, double y, double cell, std::size_t first,
               std::size_t end, Cells* __restrict cells, RowDrops& drops) {
  const double from_x = static_cast<double>(first) * cell - sweep.x;
  const double from_y = y - sweep.y;
  const auto u0 = static_cast<float>(from_x * sweep.along_x + from_y * sweep.along_y);
  const auto v0 = static_cast<float>(from_y * sweep.along_x - from_x * sweep.along_y);
  const auto du = static_cast<float>(cell * sweep.along_x);
  const auto dv = static_cast<float>(-cell * sweep.along_y);
  const float way_first = sweep.first;
  const float way_last = sweep.last;
  const float z = sweep.z;
  const float slope = sweep.slope;
  const auto rim2 = static_cast<float>(sweep.rim * sweep.rim);
  const std::size_t count = end - first;
  // Copies of their own, so that the compiler sees that writing a cell changes none of them.
  const Profile profile = of_tool;
  float* __restrict const lost = drops.values.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float u = u0 + indices[i] * du;
    const float v = v0 + indices[i] * dv;
    const float v2 = v * v;
    const float off = u - std::min(way_last, std::max(way_first, u));
    const float s = std::min(way_last, std::max(way_first, u + profile.reach(v2)));
    const float d2 = std::min(rim2, (u - s) * (u - s) + v2);
    const float under = std::max(floor, z - slope * s + profile.height(d2));
    const float before = cells[i];
    const float reached = off * off + v2 <= rim2 ? under : before;
    const float after = reached < before ? reached : before;
    lost[i] = before - after;
    if constexpr (cuts) cells[i] = after;
  }
  drops.count = (count + lanes - 1) / lanes * lanes;
  for (std::size_t i = count; i < drops.count; ++i) drops.values[i] = 0;
}

// Adds up what the rows lost. Sums run in lanes, always the same way.
class DropCount {
 public:
  // True: a cell of the row lost more than any before.
  bool add(const RowDrops& drops) {
    std::array<float, lanes> deepest{};
    for (std::size_t i = 0; i < drops.count; i += lanes) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const float drop = drops.values[i + lane];
        sum_[lane] += drop;
        deepest[lane] = drop > deepest[lane] ? drop : deepest[lane];
        cells_[lane] += drop > least_drop ? 1 : 0;
      }
    }
    const float most = *std::max_element(deepest.begin(), deepest.end());
    if (most <= deepest_) return false;
    deepest_ = most;
    return true;
  }
  float deepest() const { return deepest_; }
  void write(TileCut& cut) const {
    for (const float part : sum_) cut.drop += static_cast<double>(part);
    for (const std::int32_t part : cells_) cut.cells += static_cast<std::uint32_t>(part);
    cut.deepest = deepest_;
  }

 private:
  std::array<float, lanes> sum_{};
  std::array<std::int32_t, lanes> cells_{};
  float deepest_ = least_drop;
};

template <bool cuts, class Field>
TileCut sweep_tile(Field& field, const Tile& tile, const Sweep& sweep, const Cutter& cutter, double rim) {
  const LocalSweep local = local_sweep(field, tile, sweep, rim);
  const double cell = field.cell();
  const auto floor = static_cast<float>(field.bottom() - field.top());
  const double lowest_y = std::min(local.high_y, local.low_y) - rim;
  const double highest_y = std::max(local.high_y, local.low_y) + rim;
  const auto first_row = static_cast<std::size_t>(std::max(0.0, std::ceil(lowest_y / cell)));
  const double last_row = std::min(static_cast<double>(tile.rows) - 1, std::floor(highest_y / cell));
  TileCut cut;
  DropCount count;
  RowDrops drops;
  with_profile(cutter, local.slope, [&](const auto& profile) {
    for (std::size_t row = first_row; static_cast<double>(row) <= last_row; ++row) {
      const double y = static_cast<double>(row) * cell;
      const auto [first, end] = columns_of(local, y, cell, tile.columns);
      if (first == end) continue;
      auto* const cells = field.below_top(tile.row + row) + tile.column + first;
      sweep_row<cuts>(local, profile, floor, y, cell, first, end, cells, drops);
      if (!count.add(drops)) continue;
      const auto* const deepest = std::find(drops.values.begin(), drops.values.end(), count.deepest());
      const auto place = static_cast<std::size_t>(deepest - drops.values.begin());
      cut.column = static_cast<std::uint32_t>(tile.column + first + place);
      cut.row = static_cast<std::uint32_t>(tile.row + row);
      cut.before = cuts ? cells[place] + *deepest : cells[place];
    }
  });
  count.write(cut);
  if (cut.cells == 0) cut = {};
  return cut;
}

}  // namespace

Sweep sweep_between(const Vector3& a, const Vector3& b) {
  return a.z >= b.z ? Sweep{a, b} : Sweep{b, a};
}

TileCut cut_tile(HeightField& field, const Tile& tile, const Sweep& sweep, const Cutter& cutter, double rim) {
  return sweep_tile<true>(field, tile, sweep, cutter, rim);
}

TileCut probe_tile(const HeightField& field, const Tile& tile, const Sweep& sweep, const Cutter& cutter, double rim) {
  return sweep_tile<false>(field, tile, sweep, cutter, rim);
}

}  // namespace passo
