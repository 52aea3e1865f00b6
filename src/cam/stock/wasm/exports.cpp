// The stock as a WebAssembly module: what the scene of `passo serve` shows while a program cuts. The same sweep over
// the same height field as in `passo simulate`, for one block and one tool at a time.
//
// Lengths are mm. Heights lie in the linear memory, a float each, below the stock's top: 0 is the top.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "tile_sweep.hpp"

#include "passo/stock/height_field.hpp"

#define PASSO_EXPORT(name) __attribute__((export_name(#name))) name

namespace {

using namespace passo;

struct Stock {
  std::optional<HeightField> field;
  Cutter cutter;
  double rim = 0;
  // The rows that have changed since they were asked for: none, if the first is beyond the last.
  std::size_t first = 0;
  std::size_t last = 0;
};
Stock& stock() {
  static Stock one;
  return one;
}

// The cells from `low` to `high` along an axis, as tiles: the first one and one beyond the last.
struct Tiles {
  std::size_t from;
  std::size_t to;
};
Tiles tiles_between(double low, double high, double origin, double cell, std::size_t cells) {
  const auto index = [&](double place) {
    return static_cast<std::size_t>(std::clamp(std::floor((place - origin) / cell), 0.0, static_cast<double>(cells)));
  };
  if (high < origin) return {0, 0};
  return {index(low) / tile_size, (std::min(index(high) + 1, cells) + tile_size - 1) / tile_size};
}

}  // namespace

extern "C" {

// False: there is no such block.
bool PASSO_EXPORT(stock_begin)(double x0, double y0, double z0, double x1, double y1, double z1, double cell) {
  auto field = HeightField::create({.low = {x0, y0, z0}, .high = {x1, y1, z1}}, Mm(cell));
  if (!field) return false;
  stock().field.emplace(std::move(*field));
  stock().first = 0;
  stock().last = stock().field->rows() - 1;
  return true;
}

// The cutter from now on. Kinds: 0 flat, 1 ball, 2 V-shaped, 3 with round corners, 4 tapered with a ball. `degrees`
// between the flanks of a cone; `tip`: the diameter of its tip, or the radius of the corners. False: there is no such
// cutter.
bool PASSO_EXPORT(stock_tool)(int kind, double diameter, double degrees, double tip) {
  const double angle = degrees / 180 * std::numbers::pi;
  const Cutter cutter = kind == 1   ? Cutter::ball(Mm(diameter))
                        : kind == 2 ? Cutter::vee(Mm(diameter), {angle}, Mm(tip))
                        : kind == 3 ? Cutter::bull_nose(Mm(diameter), Mm(tip))
                        : kind == 4 ? Cutter::tapered_ball(Mm(diameter), Mm(tip), {angle / 2})
                                    : Cutter::flat_end(Mm(diameter));
  if (!flaw_of(cutter).empty()) return false;
  stock().cutter = cutter;
  stock().rim = cutter.radius.value();
  return true;
}

// The tip goes straight from a to b.
void PASSO_EXPORT(stock_cut)(double ax, double ay, double az, double bx, double by, double bz) {
  Stock& one = stock();
  if (!one.field || std::min(az, bz) >= one.field->top()) return;
  HeightField& field = *one.field;
  const Sweep sweep = sweep_between({ax, ay, az}, {bx, by, bz});
  const StockBlock& block = field.block();
  const double cell = field.cell();
  const auto across =
      tiles_between(std::min(ax, bx) - one.rim, std::max(ax, bx) + one.rim, block.low.x, cell, field.columns());
  const auto along =
      tiles_between(std::min(ay, by) - one.rim, std::max(ay, by) + one.rim, block.low.y, cell, field.rows());
  for (std::size_t j = along.from; j < along.to; ++j) {
    for (std::size_t i = across.from; i < across.to; ++i) {
      const Tile tile{.column = i * tile_size,
                      .row = j * tile_size,
                      .columns = std::min(tile_size, field.columns() - i * tile_size),
                      .rows = std::min(tile_size, field.rows() - j * tile_size)};
      if (cut_tile(field, tile, sweep, one.cutter, one.rim).cells == 0) continue;
      if (one.first > one.last) {
        one.first = tile.row;
        one.last = tile.row;
      }
      one.first = std::min(one.first, tile.row);
      one.last = std::max(one.last, tile.row + tile.rows - 1);
    }
  }
}

std::size_t PASSO_EXPORT(stock_columns)() {
  return stock().field ? stock().field->columns() : 0;
}
std::size_t PASSO_EXPORT(stock_rows)() {
  return stock().field ? stock().field->rows() : 0;
}
// Where a row lies in the linear memory.
const float* PASSO_EXPORT(stock_row)(std::size_t row) {
  return stock().field ? stock().field->below_top(row) : nullptr;
}
// The first and the last row that have changed since stock_seen(); the first is beyond the last: none.
std::size_t PASSO_EXPORT(stock_first)() {
  return stock().first;
}
std::size_t PASSO_EXPORT(stock_last)() {
  return stock().last;
}
void PASSO_EXPORT(stock_seen)() {
  stock().first = 1;
  stock().last = 0;
}
}
