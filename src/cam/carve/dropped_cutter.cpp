#include "passo/carve/dropped_cutter.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "parallel_rows.hpp"

namespace passo {
namespace {

// Heights that are computed side by side.
using Floats [[gnu::vector_size(16)]] = float;
constexpr std::size_t lanes = 4;
constexpr std::size_t chunk = 32;  // nodes that are computed together: eight vectors stay in registers
constexpr std::size_t vectors = chunk / lanes;

Floats load(const float* from) {
  Floats loaded;
  std::memcpy(&loaded, from, sizeof(loaded));
  return loaded;
}
Floats larger(Floats a, Floats b) {
  return a > b ? a : b;
}

// The plane that touches the shape above or beside the middle of a cell of the grid. The shape is convex, so it lies
// nowhere below the plane.
class TouchingPlane {
 public:
  // `x`, `y`: the cell's middle. Level planes at the tip are taken where the other one would lie below the tip: so the
  // tip is exact over a flat.
  TouchingPlane(const Cutter& cutter, double x, double y, double px, double py) {
    const double away = std::hypot(x, y);
    double distance = std::min(away, cutter.steepest().value());
    // At the rim the shape is steep, and only the inner part of the cell counts.
    const bool is_at_rim = std::hypot(x + px / 2, y + py / 2) > cutter.radius.value();
    if (is_at_rim) distance = std::min(distance, (std::hypot(x - px / 2, y - py / 2) + distance) / 2);
    slope_ = cutter.slope(Mm(distance));
    height_ = cutter.height(Mm(distance)).value() - slope_ * distance;
    if (away > 0) {
      x_ = x / away;
      y_ = y / away;
    }
    const double lowest = at(x - px / 2, y - py / 2);
    if (lowest < -2 * slope_ * CutterTable::rounding.value()) slope_ = height_ = 0;
  }
  double at(double x, double y) const { return height_ + slope_ * (x * x_ + y * y_ - CutterTable::rounding.value()); }

 private:
  double slope_ = 0;
  double height_ = 0;
  double x_ = 0;
  double y_ = 0;
};

float rounded_down(double height) {
  constexpr double steps = 65536;
  return static_cast<float>(std::floor(height * steps) / steps);
}

std::size_t reach_of(const Cutter& cutter, Mm pitch) {
  return static_cast<std::size_t>((cutter.radius + CutterTable::rounding) / pitch) + 1;
}

}  // namespace

CutterTable::CutterTable(const Cutter& cutter, Mm pitch_x, Mm pitch_y, Kind kind)
    : columns_(reach_of(cutter, pitch_x) + 1),
      rows_(reach_of(cutter, pitch_y) + 1),
      blocks_((columns_ + block - 1) / block + 1),
      heights_(columns_ * rows_, outside),
      widths_(rows_, 0),
      least_(rows_ * blocks_, outside) {
  if (kind == Kind::below) {
    put_planes(cutter, pitch_x.value(), pitch_y.value());
  } else {
    put_samples(cutter, pitch_x.value(), pitch_y.value());
  }
  count();
}

// A node's height is the least that the planes of the cells around it have there. So in each cell the patch through the
// four corners is on or below the cell's plane, and the plane is on or below the shape.
void CutterTable::put_planes(const Cutter& cutter, double px, double py) {
  const double radius = (cutter.radius + rounding).value();
  const auto lower = [&](std::size_t column, std::size_t row, double height) {
    float& place = heights_[row * columns_ + column];
    // Nothing of a relief is so deep; sums that are not this low are exact.
    constexpr double deep_enough = deepest_relief.value() + 5;
    place = std::min(place, rounded_down(std::min(height, deep_enough)));
  };
  for (std::size_t row = 0; row + 1 < rows_; ++row) {
    for (std::size_t column = 0; column + 1 < columns_; ++column) {
      const double left = static_cast<double>(column) * px;
      const double low = static_cast<double>(row) * py;
      if (std::hypot(left, low) > radius) continue;
      const TouchingPlane plane(cutter, left + px / 2, low + py / 2, px, py);
      for (const std::size_t right : {0U, 1U}) {
        for (const std::size_t up : {0U, 1U}) {
          lower(column + right, row + up,
                plane.at(left + px * static_cast<double>(right), low + py * static_cast<double>(up)));
        }
      }
    }
  }
}

void CutterTable::put_samples(const Cutter& cutter, double px, double py) {
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      const Mm away(std::hypot(static_cast<double>(column) * px, static_cast<double>(row) * py));
      if (away <= cutter.radius) heights_[row * columns_ + column] = grid_height(cutter.height(away));
    }
  }
}

void CutterTable::count() {
  for (std::size_t row = 0; row < rows_; ++row) {
    for (std::size_t column = 0; column < columns_; ++column) {
      const float height = at(column, row);
      if (height == outside) continue;
      widths_[row] = column + 1;
      float& of_row = least_[row * blocks_];
      float& of_block = least_[row * blocks_ + 1 + column / block];
      of_row = std::min(of_row, height);
      of_block = std::min(of_block, height);
    }
  }
}

DroppedCutter::DroppedCutter(const HeightGrid& grid, const Cutter& cutter, float floor, CutterTable::Kind kind,
                             BesideGrid beside)
    : grid_(grid),
      table_(cutter, grid.pitch_x, grid.pitch_y, kind),
      floor_(floor),
      goes_on_(beside == BesideGrid::goes_on),
      blocks_((grid.columns + chunk - 1) / chunk),
      tops_(blocks_ * grid.rows, nothing) {
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) {
      float& top = tops_[y * blocks_ + x / chunk];
      top = std::max(top, grid.at(x, y));
    }
  }
  if (goes_on_ && !grid.heights.empty()) keep_frame();
}

// The tip moves as far beyond the grid as the cutter reaches, and the cutter covers as much again. Farther away than
// the grid is wide, all heights are the same.
void DroppedCutter::keep_frame() {
  constexpr std::size_t some_nodes = 4'000'000;
  const auto columns = static_cast<std::ptrdiff_t>(grid_.columns);
  const auto rows = static_cast<std::ptrdiff_t>(grid_.rows);
  std::ptrdiff_t wide = std::min(columns - 1, static_cast<std::ptrdiff_t>(2 * table_.reach_x() + chunk));
  std::ptrdiff_t high = std::min(rows - 1, static_cast<std::ptrdiff_t>(2 * table_.reach_y()));
  const auto nodes = [&] { return static_cast<std::size_t>(2 * high * (columns + 2 * wide) + 2 * wide * rows); };
  while (nodes() > grid_.heights.size() + some_nodes) {
    wide /= 2;
    high /= 2;
  }
  frame_rows_.reserve(static_cast<std::size_t>(2 * high * (columns + 2 * wide)));
  for (std::ptrdiff_t i = 0; i < 2 * high; ++i) {
    const std::ptrdiff_t row = i < high ? i - high : rows + i - high;
    for (std::ptrdiff_t column = -wide; column < columns + wide; ++column) frame_rows_.push_back(beside(column, row));
  }
  frame_sides_.reserve(static_cast<std::size_t>(2 * wide * rows));
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    for (std::ptrdiff_t i = 0; i < 2 * wide; ++i)
      frame_sides_.push_back(beside(i < wide ? i - wide : columns + i - wide, row));
  }
  frame_x_ = wide;
  frame_y_ = high;
}

void DroppedCutter::heights(std::ptrdiff_t row, std::ptrdiff_t column, std::span<float> out, Scratch& scratch) const {
  float dropped[chunk];
  for (std::size_t i = 0; i < out.size(); i += chunk) {
    drop(row, column + static_cast<std::ptrdiff_t>(i), dropped, scratch);
    std::copy_n(dropped, std::min(chunk, out.size() - i), out.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

// Beside the grid the surface falls on as it falls towards the edge, or stays level.
float DroppedCutter::beside(std::ptrdiff_t column, std::ptrdiff_t row) const {
  const auto last_column = static_cast<std::ptrdiff_t>(grid_.columns) - 1;
  const auto last_row = static_cast<std::ptrdiff_t>(grid_.rows) - 1;
  const auto go_on = [&](float edge, float inside) { return std::max(floor_, std::min(edge, edge + (edge - inside))); };
  if (column < 0 || column > last_column) {
    const std::ptrdiff_t edge = column < 0 ? 0 : last_column;
    const std::ptrdiff_t inside = std::clamp<std::ptrdiff_t>(2 * edge - column, 0, last_column);
    return go_on(beside(edge, row), beside(inside, row));
  }
  if (row < 0 || row > last_row) {
    const std::ptrdiff_t edge = row < 0 ? 0 : last_row;
    const std::ptrdiff_t inside = std::clamp<std::ptrdiff_t>(2 * edge - row, 0, last_row);
    return go_on(beside(column, edge), beside(column, inside));
  }
  return grid_.at(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
}

// Raises the heights of some columns to those of a row, which may lie beside the grid.
void DroppedCutter::raise(std::ptrdiff_t row, std::ptrdiff_t begin, std::ptrdiff_t end, float* heights) const {
  const auto columns = static_cast<std::ptrdiff_t>(grid_.columns);
  const auto rows = static_cast<std::ptrdiff_t>(grid_.rows);
  std::ptrdiff_t done = begin;
  // The columns up to `last` lie together: `from` is the height of column `first`.
  const auto raise_to = [&](std::ptrdiff_t first, std::ptrdiff_t last, const float* from) {
    last = std::min(last, end);
    if (done < first || done >= last) return;
    const float* const here = from + (done - first);
    float* const to = heights + (done - begin);
    const auto count = static_cast<std::size_t>(last - done);
    for (std::size_t i = 0; i < count; ++i) to[i] = to[i] < here[i] ? here[i] : to[i];
    done = last;
  };
  const auto raise_slowly = [&](std::ptrdiff_t last) {
    for (last = std::min(last, end); done < last;) {
      const float height = beside(done, row);
      const std::ptrdiff_t stop = done < 1 - columns        ? std::min(last, 1 - columns)
                                  : done >= 2 * columns - 2 ? last
                                                            : done + 1;
      for (; done < stop; ++done) heights[done - begin] = std::max(heights[done - begin], height);
    }
  };
  row = std::clamp(row, 1 - rows, 2 * rows - 2);
  if (row >= -frame_y_ && row < rows + frame_y_) {
    raise_slowly(-frame_x_);
    if (row >= 0 && row < rows) {
      const float* const sides = frame_sides_.data() + row * 2 * frame_x_;
      raise_to(-frame_x_, 0, sides);
      raise_to(0, columns, grid_.heights.data() + row * columns);
      raise_to(columns, columns + frame_x_, sides + frame_x_);
    } else {
      const std::ptrdiff_t index = row < 0 ? row + frame_y_ : row - rows + frame_y_;
      raise_to(-frame_x_, columns + frame_x_, frame_rows_.data() + index * (columns + 2 * frame_x_));
    }
  }
  raise_slowly(end);
}

// Gathers, of the two rows so far `away`, the greater heights of all nodes that the cutter covers from this chunk.
// Returns false where none of them can lift the tip above `least`. No node beside the grid is higher than the nearest
// one of the grid.
bool DroppedCutter::combine(std::ptrdiff_t row, std::ptrdiff_t column, std::size_t away, float least,
                            Scratch& scratch) const {
  const std::span<const float> table = table_.row(away);
  if (table.empty()) return false;
  const auto wide = static_cast<std::ptrdiff_t>(table.size() - 1);
  const auto columns = static_cast<std::ptrdiff_t>(grid_.columns);
  const auto rows = static_cast<std::ptrdiff_t>(grid_.rows);
  const std::ptrdiff_t begin = column - wide;
  const std::ptrdiff_t stop = column + wide + static_cast<std::ptrdiff_t>(chunk);
  const std::ptrdiff_t first = std::clamp<std::ptrdiff_t>(begin, 0, columns);
  const std::ptrdiff_t end = std::clamp<std::ptrdiff_t>(stop, 0, columns);
  if (first >= end && !goes_on_) return false;
  std::ptrdiff_t from[2] = {};
  std::size_t count = 0;
  for (const std::ptrdiff_t to : {row + static_cast<std::ptrdiff_t>(away), row - static_cast<std::ptrdiff_t>(away)}) {
    if (goes_on_ || (to >= 0 && to < rows)) from[count++] = to;
    if (away == 0) break;
  }
  if (count == 0) return false;
  float top = nothing;
  const auto first_block = static_cast<std::size_t>(std::min(first, columns - 1)) / chunk;
  const auto last_block = static_cast<std::size_t>(std::max<std::ptrdiff_t>(end - 1, 0)) / chunk;
  for (std::size_t i = 0; i < count; ++i) {
    const auto nearest = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(from[i], 0, rows - 1));
    for (std::size_t block = std::min(first_block, last_block); block <= std::max(first_block, last_block); ++block) {
      top = std::max(top, tops_[nearest * blocks_ + block]);
    }
  }
  if (!(top - table_.least_of_row(away) > least)) return false;

  constexpr std::size_t block = CutterTable::block;
  const std::size_t size = (chunk + 2 * static_cast<std::size_t>(wide) + block - 1) / block * block;
  scratch.heights.assign(size, nothing);
  scratch.tops.assign(size / block, nothing);
  const auto is_row = [&](std::ptrdiff_t at) { return at >= 0 && at < rows; };
  const bool is_inside = is_row(from[0]) && is_row(from[count - 1]);
  float* const to = scratch.heights.data();
  if (is_inside && first < end) {
    const auto of_row = [&](std::ptrdiff_t at) {
      return &grid_.heights[static_cast<std::size_t>(at) * grid_.columns + static_cast<std::size_t>(first)];
    };
    const float* const a = of_row(from[0]);
    const float* const b = of_row(from[count - 1]);
    float* const here = to + (first - begin);
    const auto width = static_cast<std::size_t>(end - first);
    for (std::size_t i = 0; i < width; ++i) here[i] = a[i] > b[i] ? a[i] : b[i];
  }
  if (goes_on_) {
    for (std::size_t i = 0; i < count; ++i) {
      if (is_inside && first < end) {
        raise(from[i], begin, first, to);
        raise(from[i], end, stop, to + (end - begin));
      } else {
        raise(from[i], begin, stop, to);
      }
    }
  }
  for (std::size_t i = 0; i < size; i += block) {
    Floats best = load(&scratch.heights[i]);
    for (std::size_t k = lanes; k < block; k += lanes) best = larger(best, load(&scratch.heights[i + k]));
    scratch.tops[i / block] = std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
  }
  return true;
}

void DroppedCutter::drop(std::ptrdiff_t row, std::ptrdiff_t column, float* out, Scratch& scratch) const {
  Floats tips[vectors];
  for (Floats& tip : tips) tip = Floats{floor_, floor_, floor_, floor_};
  float least = floor_;
  constexpr std::size_t block = CutterTable::block;
  for (std::size_t away = 0; away <= table_.reach_y(); ++away) {
    if (!combine(row, column, away, least, scratch)) continue;
    const std::span<const float> table = table_.row(away);
    const std::size_t wide = table.size() - 1;
    const float* const middle = scratch.heights.data() + wide;
    const auto top_of = [&](std::size_t first, std::size_t last) {
      float top = nothing;
      for (std::size_t i = first / block; i <= last / block; ++i) top = std::max(top, scratch.tops[i]);
      return top;
    };
    for (std::size_t begin = 0; begin < table.size(); begin += block) {
      const std::size_t end = std::min(begin + block, table.size());
      const float top = std::max(top_of(wide - (end - 1), wide - begin + chunk - 1),
                                 top_of(wide + begin, wide + end - 1 + chunk - 1));
      if (!(top - table_.least_of_block(away, begin / block) > least)) continue;
      for (std::size_t across = begin; across < end; ++across) {
        const float height = table[across];
        const Floats of_table{height, height, height, height};
        const float* const left = middle - across;
        const float* const right = middle + across;
        for (std::size_t k = 0; k < vectors; ++k) {
          const Floats both = larger(load(left + k * lanes), load(right + k * lanes));
          tips[k] = larger(both - of_table, tips[k]);
        }
      }
      Floats lowest = tips[0];
      for (const Floats tip : tips) lowest = tip < lowest ? tip : lowest;
      least = std::min(std::min(lowest[0], lowest[1]), std::min(lowest[2], lowest[3]));
    }
  }
  std::memcpy(out, tips, sizeof(tips));
}

TipMap drop_everywhere(const DroppedCutter& cutter, std::size_t margin_x, std::size_t margin_y, unsigned threads) {
  const HeightGrid& grid = cutter.grid();
  TipMap map{.margin_x = static_cast<std::ptrdiff_t>(margin_x),
             .margin_y = static_cast<std::ptrdiff_t>(margin_y),
             .columns = grid.columns + 2 * margin_x,
             .rows = grid.rows + 2 * margin_y};
  map.heights.resize(map.columns * map.rows);
  std::vector<DroppedCutter::Scratch> scratch(threads);
  for_each_row(map.rows, threads, [&](std::size_t row, std::size_t thread) {
    cutter.heights(static_cast<std::ptrdiff_t>(row) - map.margin_y, -map.margin_x,
                   {&map.heights[row * map.columns], map.columns}, scratch[thread]);
  });
  return map;
}

}  // namespace passo
