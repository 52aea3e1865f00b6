// Roughing by offset: on each level the cutter goes round and round, along lines that are evenly far from the edge of
// what the level takes off, from within outwards.
#include <algorithm>
#include <cmath>
#include <limits>

#include "relief_passes.hpp"

namespace passo {
namespace {

// The map with a rim of one node that no height reaches: so level lines are closed along its edge.
TipMap walled(const TipMap& map) {
  constexpr float wall = 1e6F;
  TipMap wide{.margin_x = map.margin_x + 1,
              .margin_y = map.margin_y + 1,
              .columns = map.columns + 2,
              .rows = map.rows + 2,
              .heights = std::vector<float>((map.columns + 2) * (map.rows + 2), wall)};
  for (std::size_t row = 0; row < map.rows; ++row) {
    std::copy_n(&map.heights[row * map.columns], map.columns, &wide.heights[(row + 1) * wide.columns + 1]);
  }
  return wide;
}

// How far each node is from the nearest of some places. The nearest place is handed on from node to node, there and
// back over the rows. Source: P.-E. Danielsson, Euclidean distance mapping (1980).
class DistanceField {
 public:
  DistanceField(const TipMap& map, Mm pitch_x, Mm pitch_y)
      : map_(map),
        pitch_x_(static_cast<float>(pitch_x.value())),
        pitch_y_(static_cast<float>(pitch_y.value())),
        nearest_(map.columns * map.rows, {never, never}) {}

  void add(const FlatPlace& place) {
    const auto column = static_cast<std::ptrdiff_t>(std::floor(place.x / static_cast<double>(pitch_x_)));
    const auto row = static_cast<std::ptrdiff_t>(std::floor(place.y / static_cast<double>(pitch_y_)));
    const Near near{static_cast<float>(place.x), static_cast<float>(place.y)};
    for (std::ptrdiff_t y = row + map_.margin_y; y <= row + map_.margin_y + 1; ++y) {
      for (std::ptrdiff_t x = column + map_.margin_x; x <= column + map_.margin_x + 1; ++x) {
        if (x < 0 || y < 0 || x >= columns() || y >= rows()) continue;
        take(x, y, near);
      }
    }
  }
  void spread() {
    for (std::ptrdiff_t row = 0; row < rows(); ++row) sweep_row(row, -1);
    for (std::ptrdiff_t row = rows() - 1; row >= 0; --row) sweep_row(row, 1);
  }
  // By the node's place in the map: margins counted.
  float distance(std::ptrdiff_t column, std::ptrdiff_t row) const { return away(column, row, at(column, row)); }

 private:
  static constexpr float never = std::numeric_limits<float>::infinity();
  struct Near {
    float x;
    float y;
  };

  std::ptrdiff_t columns() const { return static_cast<std::ptrdiff_t>(map_.columns); }
  std::ptrdiff_t rows() const { return static_cast<std::ptrdiff_t>(map_.rows); }
  const Near& at(std::ptrdiff_t column, std::ptrdiff_t row) const {
    return nearest_[static_cast<std::size_t>(row * columns() + column)];
  }
  float away(std::ptrdiff_t column, std::ptrdiff_t row, const Near& near) const {
    const float x = static_cast<float>(column - map_.margin_x) * pitch_x_ - near.x;
    const float y = static_cast<float>(row - map_.margin_y) * pitch_y_ - near.y;
    return std::sqrt(x * x + y * y);
  }
  void take(std::ptrdiff_t column, std::ptrdiff_t row, const Near& near) {
    if (near.x == never) return;
    Near& own = nearest_[static_cast<std::size_t>(row * columns() + column)];
    if (own.x == never || away(column, row, near) < away(column, row, own)) own = near;
  }
  // From the row before, in the direction `from`, and then from both neighbours.
  void sweep_row(std::ptrdiff_t row, std::ptrdiff_t from) {
    const std::ptrdiff_t other = row + from;
    if (other >= 0 && other < rows()) {
      for (std::ptrdiff_t column = 0; column < columns(); ++column) {
        for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, column - 1); x <= std::min(columns() - 1, column + 1);
             ++x) {
          take(column, row, at(x, other));
        }
      }
    }
    for (std::ptrdiff_t column = 1; column < columns(); ++column) take(column, row, at(column - 1, row));
    for (std::ptrdiff_t column = columns() - 1; column-- > 0;) take(column, row, at(column + 1, row));
  }

  const TipMap& map_;
  float pitch_x_;
  float pitch_y_;
  std::vector<Near> nearest_;
};

// A loop, and the loops within it that are one row farther inside.
struct Loop {
  LevelLine line;
  FlatPlace low;
  FlatPlace high;
  std::vector<std::size_t> within;  // in the next ring
};

class OffsetRoughing {
 public:
  OffsetRoughing(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice, const TipMap& tips)
      : pass_(pass),
        surface_(surface),
        lattice_(lattice),
        tips_(tips),
        walled_(walled(tips)),
        tip_surface_(tips, surface.pitch_x, surface.pitch_y),
        lines_(walled_, surface.pitch_x, surface.pitch_y),
        step_(step_of(pass.options().roughing->tool, pass.options(), true).value()) {}

  void cut_level(float above, float level) {
    above_ = above - least;
    level_ = level;
    rings_.clear();
    find_rings();
    for (std::size_t i = 0; i < rings_.front().size(); ++i) cut_from(0, i, false);
    for (const LevelLine& line : walls_) cut(line, true, false);
    cut_what_is_left();
  }

 private:
  static constexpr float least = 0.001F;  // mm; less is no work

  double pitch() const { return std::max(surface_.pitch_x, surface_.pitch_y).value(); }
  LevelPathFit fit(bool is_wall) const {
    const ReliefProgramOptions& options = pass_.options();
    // What roughing leaves is no matter of the tolerance.
    const double loose = std::max(options.tolerance.value(), options.roughing->stock.value() / 10);
    return {.tolerance = loose, .has_arcs = options.arcs, .is_on_edge = is_wall};
  }

  void find_rings() {
    DistanceField from_edge(walled_, surface_.pitch_x, surface_.pitch_y);
    walls_.clear();
    rings_.emplace_back();
    const double shallow = 0.05 * static_cast<double>(above_ - level_);
    lines_.trace(above_, [&](LevelLine&& line) {
      for (const FlatPlace& place : line.points) from_edge.add(place);
      // Along the map's edge the surface may lie between the levels.
      const auto wants = [&](const FlatPlace& place) {
        const double height = tip_surface_.at(place);
        return height > static_cast<double>(level_) && height < static_cast<double>(above_) - shallow;
      };
      for (LevelLine& part : parts_of(line, wants, 0, step_)) walls_.push_back(std::move(part));
    });
    lines_.trace(level_, [&](LevelLine&& line) { walls_.push_back(std::move(line)); });
    from_edge.spread();
    TipMap inwards = walled_;
    float deepest = 0;
    for (std::size_t i = 0; i < inwards.heights.size(); ++i) {
      const auto column = static_cast<std::ptrdiff_t>(i % inwards.columns);
      const auto row = static_cast<std::ptrdiff_t>(i / inwards.columns);
      float& height = inwards.heights[i];
      const float away = from_edge.distance(column, row);
      height = height <= above_ ? -away : std::min(away, 1e3F);
      if (!std::isfinite(height)) height = 0;
      deepest = std::min(deepest, height);
    }
    LevelLines offsets(inwards, surface_.pitch_x, surface_.pitch_y);
    for (double away = step_; away < -static_cast<double>(deepest); away += step_) {
      std::vector<Loop> ring;
      offsets.trace(static_cast<float>(-away), [&](LevelLine&& line) { ring.push_back(loop_of(std::move(line))); });
      if (away > step_) put_within(ring);
      if (away > step_) rings_.emplace_back();
      rings_.back() = std::move(ring);
    }
  }

  static Loop loop_of(LevelLine&& line) {
    Loop loop{.line = std::move(line), .low = {}, .high = {}, .within = {}};
    loop.low = loop.high = loop.line.points.front();
    for (const FlatPlace& point : loop.line.points) {
      loop.low = {std::min(loop.low.x, point.x), std::min(loop.low.y, point.y)};
      loop.high = {std::max(loop.high.x, point.x), std::max(loop.high.y, point.y)};
    }
    return loop;
  }

  // Each loop belongs to that one of the ring before which is nearest.
  void put_within(const std::vector<Loop>& ring) {
    std::vector<Loop>& outer = rings_.back();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const FlatPlace& place = ring[i].line.points.front();
      double best = std::numeric_limits<double>::infinity();
      Loop* around = nullptr;
      for (Loop& loop : outer) {
        const double out = std::hypot(std::max({loop.low.x - place.x, place.x - loop.high.x, 0.0}),
                                      std::max({loop.low.y - place.y, place.y - loop.high.y, 0.0}));
        if (out > best) continue;
        for (const FlatPlace& point : loop.line.points) {
          const double away = distance_between(point, place);
          if (away < best) best = away, around = &loop;
        }
      }
      if (around != nullptr) around->within.push_back(i);
    }
  }

  // What is within first. Returns whether something was cut there.
  void cut_from(std::size_t ring, std::size_t index, bool is_within) {
    const Loop& loop = rings_[ring][index];
    // The innermost loop is left out where the cutter takes all of it from the one around.
    const bool is_small = std::max(loop.high.x - loop.low.x, loop.high.y - loop.low.y) < step_ / 4;
    if (loop.within.empty() && is_within && is_small) return;
    for (const std::size_t inner : loop.within) cut_from(ring + 1, inner, true);
    cut(loop.line, false, !loop.within.empty());
  }

  void cut(const LevelLine& way, bool is_wall, bool sideways) {
    LevelLine line = way;
    begin_near(line, pass_.flat_place());
    const double level = static_cast<double>(level_);
    const bool is_level = std::all_of(line.points.begin(), line.points.end(), [&](const FlatPlace& place) {
      return tip_surface_.at(place) <= level + LevelLines::slack;
    });
    const LevelPath path = is_level ? fit_level_path(line, level, tip_surface_, lattice_, fit(is_wall))
                                    : fit_following_path(line, level, tip_surface_, lattice_, fit(is_wall));
    pass_.cut_way(path, tip_surface_, {.near = step_ * 1.5, .sideways = sideways, .is_for_stock = true});
  }

  // Corners between loops, and what is too narrow for a loop: in rows, where the cutter would take off something.
  void cut_what_is_left() {
    DistanceField from_ways(walled_, surface_.pitch_x, surface_.pitch_y);
    const auto add = [&](const LevelLine& line) {
      for (const FlatPlace& place : line.points) from_ways.add(place);
    };
    for (const std::vector<Loop>& ring : rings_) {
      for (const Loop& loop : ring) add(loop.line);
    }
    for (const LevelLine& line : walls_) add(line);
    from_ways.spread();
    const Cutter& cutter = pass_.options().roughing->tool.cutter;
    const auto covered = static_cast<float>(std::max(cutter.flat.value() - pitch(), step_ * 0.6));
    const double thick = 0.1 * static_cast<double>(above_ - level_);
    const auto height = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
      return std::max(tips_.at(column, row), level_);
    };
    const auto free_above = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
      const FlatPlace place{static_cast<double>(column) * surface_.pitch_x.value(),
                            static_cast<double>(row) * surface_.pitch_y.value()};
      return static_cast<float>(pass_.stock()->free_height(place, 0));
    };
    const auto wants = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
      if (tips_.at(column, row) >= above_) return false;
      const float away = from_ways.distance(column + walled_.margin_x, row + walled_.margin_y);
      if (away <= covered) return false;
      return static_cast<double>(free_above(column, row) - height(column, row)) > thick;
    };
    const std::ptrdiff_t step = step_nodes(Mm(step_), surface_.pitch_y);
    AreaSweep sweep(pass_, area_of(tips_, step, nodes_of(cutter.radius, surface_.pitch_x)), wants, height, free_above);
    sweep.cut([](double) {});
  }

  ReliefPass& pass_;
  const HeightGrid& surface_;
  const NodeLattice& lattice_;
  const TipMap& tips_;
  TipMap walled_;
  TipSurface tip_surface_;
  LevelLines lines_;
  double step_;
  float above_ = 0;
  float level_ = 0;
  std::vector<std::vector<Loop>> rings_;  // from the edge inwards
  std::vector<LevelLine> walls_;
};

}  // namespace

void rough_by_offsets(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                      const std::function<void(double)>& progress) {
  const ReliefRoughing& roughing = *pass.options().roughing;
  const TipMap tips = roughing_tips(surface, lattice, pass.options());
  const float lowest = *std::min_element(tips.heights.begin(), tips.heights.end());
  pass.set_lattice(lattice);
  pass.writer().set_feeds({.along = roughing.tool.feed, .down = roughing.tool.plunge});
  const double levels = std::ceil(-static_cast<double>(lowest) / roughing.step_down.value() - 1e-6);
  OffsetRoughing work(pass, surface, lattice, tips);
  for (double i = 0; i < levels; ++i) {
    const auto height = [&](double of) { return static_cast<float>(static_cast<double>(lowest) * of / levels); };
    work.cut_level(height(i), height(i + 1));
    progress((i + 1) / levels);
  }
}

}  // namespace passo
