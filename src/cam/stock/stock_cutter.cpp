#include "passo/stock/stock_cutter.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "tile_sweep.hpp"

namespace passo {
namespace {

// Chords that are cut at once: so many that the threads are worth their start.
constexpr std::size_t batch_chords = 8192;
constexpr unsigned most_threads = 64;
// Of these, so many at once are noted in tiles: a chord of a wide tool is in many.
constexpr std::size_t most_notes = std::size_t{1} << 20U;
// A chord may be this share of a cell away from its curve.
constexpr double chord_share = 0.1;
constexpr double most_chords_of_a_move = 1e6;
// A tool that goes up along the wall that it has just cut takes nothing. Rounding must not make this a rapid through
// the stock: on rapids the tool is thinner by this share of a cell.
constexpr double rapid_share = 0.125;
// Volumes are added as whole numbers: so their order does not matter. Units of a cell's area times a millimetre.
constexpr double volume_units = 1 << 24;

struct SweptChord {
  Sweep sweep;
  std::uint32_t move = 0;  // of the batch
};

struct Deepest {
  float depth = 0;
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  float before = 0;

  // Of equal depths the first cell counts, in whatever order the tiles are done.
  void take(const Deepest& other) {
    const bool first = std::pair(other.row, other.column) < std::pair(row, column);
    if (other.depth > depth || (other.depth == depth && depth > 0 && first)) *this = other;
  }
};

Deepest deepest_of(const TileCut& cut) {
  return {.depth = cut.cells > 0 ? cut.deepest : 0, .column = cut.column, .row = cut.row, .before = cut.before};
}

// What a move did, in the tiles of one thread.
struct MoveTally {
  std::int64_t volume = 0;
  std::uint64_t cells = 0;
  Deepest cut;
  Deepest holder;
  double lowest = std::numeric_limits<double>::infinity();  // of the tip, where it cut

  void take(const MoveTally& other) {
    volume += other.volume;
    cells += other.cells;
    cut.take(other.cut);
    holder.take(other.holder);
    lowest = std::min(lowest, other.lowest);
  }
};

struct TileWork {
  Tile tile;
  float top = 0;                      // its highest cell, from the stock's top
  std::vector<std::uint32_t> chords;  // of the batch
  std::vector<WallHeights::Patch*> patches = {};
};

// A cylinder in place of the cutter, for the holder.
Cutter holder_of(const ToolShape& tool) {
  return Cutter::flat_end(tool.holder_radius * 2);
}

Sweep raised(const Sweep& sweep, Mm height) {
  const Vector3 up{0, 0, height.value()};
  return {sweep.high + up, sweep.low + up};
}

std::vector<Tile> tiles_of(const HeightField& field) {
  std::vector<Tile> tiles;
  for (std::size_t row = 0; row < field.rows(); row += tile_size) {
    for (std::size_t column = 0; column < field.columns(); column += tile_size) {
      tiles.push_back({.column = column,
                       .row = row,
                       .columns = std::min(tile_size, field.columns() - column),
                       .rows = std::min(tile_size, field.rows() - row)});
    }
  }
  return tiles;
}

struct TileRange {
  std::size_t first = 0;
  std::size_t end = 0;
};

// The tiles along one axis that an interval touches. `low` is where the field begins.
TileRange tiles_along(double from, double to, double low, double cell, std::size_t tiles) {
  const double size = cell * static_cast<double>(tile_size);
  const double first = std::floor((from - low) / size - 1e-9);
  const double last = std::floor((to - low) / size + 1e-9);
  if (last < 0 || first >= static_cast<double>(tiles)) return {};
  return {static_cast<std::size_t>(std::max(0.0, first)),
          static_cast<std::size_t>(std::min(static_cast<double>(tiles), last + 1))};
}

// Whether a sweep comes within `reach` of a tile, or nearly so.
bool comes_near(const Sweep& sweep, const HeightField& field, const Tile& tile, double reach) {
  const double half_x = 0.5 * static_cast<double>(tile.columns) * field.cell();
  const double half_y = 0.5 * static_cast<double>(tile.rows) * field.cell();
  const Vector3 middle{field.x_of(tile.column) - 0.5 * field.cell() + half_x,
                       field.y_of(tile.row) - 0.5 * field.cell() + half_y, 0};
  const Vector3 nearest = nearest_of({sweep.high.x, sweep.high.y, 0}, {sweep.low.x, sweep.low.y, 0}, middle) - middle;
  const double far = reach + std::sqrt(half_x * half_x + half_y * half_y);
  return nearest.x * nearest.x + nearest.y * nearest.y <= far * far;
}

// What stands in the way beside the stock.
struct Clamp {
  HeightField field;
  std::vector<Tile> tiles;
};

}  // namespace

class StockCutter::Implementation {
 public:
  Implementation(HeightField& field, const StockCutterOptions& options, Watcher watcher);
  Implementation(const HeightField& field, WallHeights& walls, const StockCutterOptions& options);

  void cut(const Curve& curve, const Vector3& zero, const StockMove& move);
  void finish();

 private:
  std::size_t sort_into_tiles(std::size_t first);
  void cut_busy_tiles(std::vector<std::vector<MoveTally>>& tallies);
  void cut_tiles(std::atomic<std::size_t>& next, std::vector<MoveTally>& tallies);
  void cut_one(TileWork& work, std::vector<MoveTally>& tallies);
  void cut_patch(HeightField& patch, const std::vector<std::uint32_t>& chords) const;
  double rim_of(const SweptChord& chord) const;
  void look_at_clamps(const SweptChord& chord, MoveCut& cut) const;
  void write(const MoveTally& tally, MoveCut& cut) const;
  Vector3 place_of(const Deepest& deepest) const;
  const ToolShape& tool_of(const SweptChord& chord) const { return options_.tools[moves_[chord.move].move.tool]; }

  const HeightField& field_;
  HeightField* cut_field_;  // null: only walls are cut
  StockCutterOptions options_;
  Watcher watcher_;
  double finest_cell_;      // of the stock and of all clamps
  double beyond_tile_ = 0;  // how far the patches of a tile extend over its edge
  std::vector<Clamp> clamps_;
  std::size_t tiles_across_ = 0;
  std::vector<TileWork> tiles_;
  std::vector<std::size_t> busy_;  // the tiles that have chords
  std::vector<SweptChord> chords_;
  std::vector<MoveCut> moves_;
};

StockCutter::Implementation::Implementation(HeightField& field, const StockCutterOptions& options, Watcher watcher)
    : field_(field), cut_field_(&field), options_(options), watcher_(std::move(watcher)), finest_cell_(field.cell()) {
  options_.threads = std::clamp(options_.threads, 1U, most_threads);
  tiles_across_ = (field_.columns() + tile_size - 1) / tile_size;
  for (const Tile& tile : tiles_of(field_)) {
    float top = -std::numeric_limits<float>::infinity();
    for (std::size_t row = tile.row; row < tile.row + tile.rows; ++row) {
      const float* const cells = field_.below_top(row) + tile.column;
      top = std::max(top, *std::max_element(cells, cells + tile.columns));
    }
    tiles_.push_back({.tile = tile, .top = top, .chords = {}});
  }
  for (const StockBlock& block : options_.clamps) {
    Result<HeightField, FieldRefusal> clamp = HeightField::create(block, clamp_cell(block, field_));
    if (!clamp) continue;
    finest_cell_ = std::min(finest_cell_, clamp->cell());
    std::vector<Tile> tiles = tiles_of(*clamp);
    clamps_.push_back({std::move(*clamp), std::move(tiles)});
  }
}

StockCutter::Implementation::Implementation(const HeightField& field, WallHeights& walls,
                                            const StockCutterOptions& options)
    : field_(field),
      cut_field_(nullptr),
      options_(options),
      finest_cell_(walls.spacing().value()),
      beyond_tile_(walls.patch_size().value()) {
  options_.threads = std::clamp(options_.threads, 1U, most_threads);
  tiles_across_ = (field_.columns() + tile_size - 1) / tile_size;
  for (const Tile& tile : tiles_of(field_)) tiles_.push_back({.tile = tile, .top = 0, .chords = {}});
  for (WallHeights::Patch& patch : walls.patches()) {
    tiles_[patch.row / tile_size * tiles_across_ + patch.column / tile_size].patches.push_back(&patch);
  }
}

void StockCutter::Implementation::cut(const Curve& curve, const Vector3& zero, const StockMove& move) {
  const auto at = [&](Mm s) { return Vector3::of(curve.at(s)) - zero; };
  MoveCut cut{.move = move};
  const Vector3 start = Vector3::of(curve.start()) - zero;
  const Vector3 end = Vector3::of(curve.end()) - zero;
  // The distance of a chord of length L from a curve is at most L² curvature / 8.
  const double length = curve.length().value();
  const double tolerance = chord_share * finest_cell_;
  const double wanted = std::ceil(length * std::sqrt(curve.curvature() / (8 * tolerance)));
  const double count = std::clamp(wanted, 1.0, most_chords_of_a_move);
  const auto number = static_cast<std::uint32_t>(moves_.size());
  Vector3 before = start;
  for (double i = 1; i <= count; ++i) {
    const Vector3 here = i < count ? at(Mm(length * i / count)) : end;
    const Vector3 way = here - before;
    cut.way += passo::length(way);
    cut.way_level += std::sqrt(way.x * way.x + way.y * way.y);
    chords_.push_back({sweep_between(before, here), number});
    before = here;
  }
  moves_.push_back(cut);
  if (chords_.size() >= batch_chords) finish();
}

// A chord goes to the tiles that its tool may cut, or its holder touch. Returns the first chord that must wait.
std::size_t StockCutter::Implementation::sort_into_tiles(std::size_t first) {
  busy_.clear();
  std::size_t notes = 0;
  const StockBlock& block = field_.block();
  const std::size_t tiles_up = tiles_.size() / tiles_across_;
  std::size_t i = first;
  for (; i < chords_.size() && notes < most_notes; ++i) {
    const Sweep& sweep = chords_[i].sweep;
    const ToolShape& tool = tool_of(chords_[i]);
    const double lowest = sweep.low.z - block.high.z;
    if (lowest >= 0) continue;
    const bool holder_is_low = tool.holder_radius > Mm(0) && lowest + tool.holder_from.value() < 0;
    const Mm radius = tool.cutter.radius;
    const double reach = (holder_is_low ? std::max(radius, tool.holder_radius) : radius).value() + beyond_tile_;
    const auto [left, right] = std::minmax(sweep.high.x, sweep.low.x);
    const auto [lower, upper] = std::minmax(sweep.high.y, sweep.low.y);
    const TileRange across = tiles_along(left - reach, right + reach, block.low.x, field_.cell(), tiles_across_);
    const TileRange up = tiles_along(lower - reach, upper + reach, block.low.y, field_.cell(), tiles_up);
    for (std::size_t row = up.first; row < up.end; ++row) {
      for (std::size_t column = across.first; column < across.end; ++column) {
        TileWork& work = tiles_[row * tiles_across_ + column];
        if (cut_field_ == nullptr && work.patches.empty()) continue;
        if (lowest >= static_cast<double>(work.top) || !comes_near(sweep, field_, work.tile, reach)) continue;
        if (work.chords.empty()) busy_.push_back(row * tiles_across_ + column);
        work.chords.push_back(static_cast<std::uint32_t>(i));
        ++notes;
      }
    }
  }
  return i;
}

// The radius within which the tool removes material.
double StockCutter::Implementation::rim_of(const SweptChord& chord) const {
  const ToolShape& tool = tool_of(chord);
  const StockMove& move = moves_[chord.move].move;
  if (tool.neck_radius > Mm(0) && !move.rapid) return tool.neck_radius.value();
  const double cell = cut_field_ != nullptr ? field_.cell() : finest_cell_;
  const double thinner = move.rapid ? rapid_share * cell + move.rounding.value() : 0;
  const double radius = tool.cutter.radius.value();
  return std::max(0.5 * radius, radius - thinner);
}

void StockCutter::Implementation::cut_patch(HeightField& patch, const std::vector<std::uint32_t>& chords) const {
  const Tile whole{.column = 0, .row = 0, .columns = patch.columns(), .rows = patch.rows()};
  const auto highest = [&] {
    float top = patch.below_top(0)[0];
    for (std::size_t row = 0; row < patch.rows(); ++row) {
      top = std::max(top, *std::max_element(patch.below_top(row), patch.below_top(row) + patch.columns()));
    }
    return static_cast<double>(top);
  };
  double top = highest();
  for (const std::uint32_t i : chords) {
    const SweptChord& chord = chords_[i];
    const Cutter& cutter = tool_of(chord).cutter;
    if (chord.sweep.low.z - patch.top() >= top) continue;
    if (!comes_near(chord.sweep, patch, whole, cutter.radius.value())) continue;
    if (cut_tile(patch, whole, chord.sweep, cutter, rim_of(chord)).cells > 0) top = highest();
  }
}

void StockCutter::Implementation::cut_one(TileWork& work, std::vector<MoveTally>& tallies) {
  if (cut_field_ == nullptr) {
    for (WallHeights::Patch* patch : work.patches) cut_patch(patch->heights, work.chords);
    work.chords.clear();
    return;
  }
  for (const std::uint32_t i : work.chords) {
    const SweptChord& chord = chords_[i];
    const ToolShape& tool = tool_of(chord);
    MoveTally& tally = tallies[chord.move];
    const TileCut cut = cut_tile(*cut_field_, work.tile, chord.sweep, tool.cutter, rim_of(chord));
    if (cut.cells > 0) {
      tally.volume += std::llround(cut.drop * volume_units);
      tally.cells += cut.cells;
      tally.cut.take(deepest_of(cut));
      tally.lowest = std::min(tally.lowest, chord.sweep.low.z);
    }
    if (!(tool.holder_radius > Mm(0))) continue;
    const Sweep holder = raised(chord.sweep, tool.holder_from);
    if (holder.low.z - field_.top() >= static_cast<double>(work.top)) continue;
    tally.holder.take(deepest_of(probe_tile(field_, work.tile, holder, holder_of(tool), tool.holder_radius.value())));
  }
  work.chords.clear();
  float top = -std::numeric_limits<float>::infinity();
  for (std::size_t row = work.tile.row; row < work.tile.row + work.tile.rows; ++row) {
    const float* const cells = field_.below_top(row) + work.tile.column;
    top = std::max(top, *std::max_element(cells, cells + work.tile.columns));
  }
  work.top = top;
}

void StockCutter::Implementation::cut_tiles(std::atomic<std::size_t>& next, std::vector<MoveTally>& tallies) {
  for (std::size_t i = next++; i < busy_.size(); i = next++) cut_one(tiles_[busy_[i]], tallies);
}

void StockCutter::Implementation::look_at_clamps(const SweptChord& chord, MoveCut& cut) const {
  const ToolShape& tool = tool_of(chord);
  const auto look = [&](const Clamp& clamp, const Sweep& sweep, const Cutter& shape) {
    if (sweep.low.z >= clamp.field.top()) return;
    for (const Tile& tile : clamp.tiles) {
      if (!comes_near(sweep, clamp.field, tile, shape.radius.value())) continue;
      const TileCut hit = probe_tile(clamp.field, tile, sweep, shape, shape.radius.value());
      if (hit.cells == 0 || static_cast<double>(hit.deepest) <= cut.clamp) continue;
      cut.clamp = static_cast<double>(hit.deepest);
      cut.clamp_place = {clamp.field.x_of(hit.column), clamp.field.y_of(hit.row), clamp.field.top()};
    }
  };
  for (const Clamp& clamp : clamps_) {
    look(clamp, chord.sweep, tool.cutter);
    if (tool.holder_radius > Mm(0)) look(clamp, raised(chord.sweep, tool.holder_from), holder_of(tool));
  }
}

Vector3 StockCutter::Implementation::place_of(const Deepest& deepest) const {
  return {field_.x_of(deepest.column), field_.y_of(deepest.row), field_.top() + static_cast<double>(deepest.before)};
}

void StockCutter::Implementation::write(const MoveTally& tally, MoveCut& cut) const {
  const double cell_area = field_.cell() * field_.cell();
  cut.volume = static_cast<double>(tally.volume) / volume_units * cell_area;
  cut.area = static_cast<double>(tally.cells) * cell_area;
  cut.depth = static_cast<double>(tally.cut.depth);
  if (cut.depth > 0) cut.place = place_of(tally.cut);
  cut.below = std::max(0.0, field_.bottom() - tally.lowest);
  cut.holder = static_cast<double>(tally.holder.depth);
  if (cut.holder > 0) cut.holder_place = place_of(tally.holder);
}

void StockCutter::Implementation::cut_busy_tiles(std::vector<std::vector<MoveTally>>& tallies) {
  // Cutting a few chords takes less time than starting a thread.
  constexpr std::size_t chords_a_thread = 64;
  const std::size_t worth = std::max<std::size_t>(1, std::min(busy_.size(), chords_.size() / chords_a_thread));
  const std::size_t threads = std::min(tallies.size(), worth);
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) {
    others.emplace_back([this, &next, &own = tallies[i]] { cut_tiles(next, own); });
  }
  cut_tiles(next, tallies.front());
  for (std::thread& other : others) other.join();
}

void StockCutter::Implementation::finish() {
  std::vector<std::vector<MoveTally>> tallies(options_.threads, std::vector<MoveTally>(moves_.size()));
  for (std::size_t first = 0; first < chords_.size();) {
    first = sort_into_tiles(first);
    cut_busy_tiles(tallies);
  }
  for (std::size_t move = 0; move < moves_.size(); ++move) {
    MoveTally all = tallies.front()[move];
    for (std::size_t i = 1; i < tallies.size(); ++i) all.take(tallies[i][move]);
    write(all, moves_[move]);
  }
  for (const SweptChord& chord : chords_) look_at_clamps(chord, moves_[chord.move]);
  if (watcher_) {
    for (const MoveCut& cut : moves_) watcher_(cut);
  }
  chords_.clear();
  moves_.clear();
}

Mm StockCutter::clamp_cell(const StockBlock& clamp, const HeightField& field) {
  constexpr double most_cells = 2e5;
  const double area = (clamp.high.x - clamp.low.x) * (clamp.high.y - clamp.low.y);
  double cell = field.cell();
  for (const double finer : {5.0, 2.0, 1.0, 0.5, 0.2}) {
    if (finer < cell && area / (finer * finer) <= most_cells) cell = finer;
  }
  return Mm(cell);
}

StockCutter::StockCutter(HeightField& field, const StockCutterOptions& options, Watcher watcher)
    : implementation_(std::make_unique<Implementation>(field, options, std::move(watcher))) {}

StockCutter::StockCutter(const HeightField& field, WallHeights& walls, const StockCutterOptions& options)
    : implementation_(std::make_unique<Implementation>(field, walls, options)) {}

StockCutter::~StockCutter() = default;

void StockCutter::cut(const Curve& curve, const Vector3& zero, const StockMove& move) {
  implementation_->cut(curve, zero, move);
}

void StockCutter::finish() {
  implementation_->finish();
}

}  // namespace passo
