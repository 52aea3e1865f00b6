// The parts of a relief's program: roughing, finishing and rest finishing.
#include <algorithm>
#include <cmath>

#include "relief_passes.hpp"

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

// How many nodes the tip goes beyond the surface.
std::ptrdiff_t overrun_nodes(Mm overrun, Mm pitch) {
  return static_cast<std::ptrdiff_t>(std::ceil(overrun / pitch - 1e-6));
}

}  // namespace

AreaSweep::Area area_of(const TipMap& map, std::ptrdiff_t step, std::ptrdiff_t gap) {
  return {.first_column = -map.margin_x,
          .end_column = static_cast<std::ptrdiff_t>(map.columns) - map.margin_x,
          .first_row = -map.margin_y,
          .end_row = static_cast<std::ptrdiff_t>(map.rows) - map.margin_y,
          .step = step,
          .gap = gap};
}

TipMap tips_of(const HeightGrid& surface, const Cutter& cutter, float floor, Mm overrun,
               const ReliefProgramOptions& options) {
  return drop_everywhere(DroppedCutter(surface, cutter, floor, CutterTable::Kind::below, options.beside),
                         static_cast<std::size_t>(overrun_nodes(overrun, surface.pitch_x)),
                         static_cast<std::size_t>(overrun_nodes(overrun, surface.pitch_y)), options.threads);
}

// The tip of the grown shape is lower by the stock.
TipMap roughing_tips(const HeightGrid& surface, const NodeLattice& lattice, const ReliefProgramOptions& options) {
  const ReliefRoughing& roughing = *options.roughing;
  const float stock = grid_height(roughing.stock);
  TipMap tips = tips_of(surface, roughing.tool.cutter.grown(roughing.stock), floor_of(surface),
                        roughing_overrun(options), options);
  for (float& height : tips.heights) height = std::min(0.0F, height + stock);
  if (options.area.is_all()) return tips;
  // Where there is no work, the tip stays at the top. The finishing cutter must find room around the model.
  const Mm around = options.finish.cutter.radius * 2 + step_of(roughing.tool, options, true);
  const NodeMask work = nodes_of_work(tips, surface, lattice, around, floor_of(surface) + stock, options);
  for (std::size_t row = 0; row < tips.rows; ++row) {
    for (std::size_t column = 0; column < tips.columns; ++column) {
      const bool is_work = work.at(static_cast<std::ptrdiff_t>(column) - tips.margin_x,
                                   static_cast<std::ptrdiff_t>(row) - tips.margin_y);
      if (!is_work) tips.heights[row * tips.columns + column] = 0;
    }
  }
  return tips;
}

// Level by level. On each level the cutter follows the surface where that is higher than the level, so that what it
// leaves is even; it does so only where the level before was not as deep.
void rough_out(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
               const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const ReliefRoughing& roughing = *options.roughing;
  const TipMap tips = roughing_tips(surface, lattice, options);
  const float lowest = *std::min_element(tips.heights.begin(), tips.heights.end());
  pass.set_lattice(lattice);
  pass.writer().set_feeds({.along = roughing.tool.feed, .down = roughing.tool.plunge});
  const std::ptrdiff_t step = step_nodes(step_of(roughing.tool, options, true), surface.pitch_y);
  const auto levels =
      static_cast<std::size_t>(std::ceil(-static_cast<double>(lowest) / roughing.step_down.value() - 1e-6));
  const AreaSweep::Area area = area_of(tips, step, nodes_of(roughing.tool.cutter.radius, surface.pitch_x));
  for (std::size_t i = 0; i < levels; ++i) {
    const double down = -static_cast<double>(lowest) / static_cast<double>(levels);
    const auto above = static_cast<float>(-down * static_cast<double>(i));
    const auto level = static_cast<float>(-down * static_cast<double>(i + 1));
    const float least = 0.001F;  // mm; less is no work
    AreaSweep sweep(
        pass, area, [&](auto column, auto row) { return tips.at(column, row) < above - least; },
        [&](auto column, auto row) { return std::max(tips.at(column, row), level); },
        [&](auto, auto) { return above; });
    sweep.cut([&](double share) { progress((static_cast<double>(i) + share) / static_cast<double>(levels)); });
  }
}

namespace {

// The tip's heights of the rows of work, computed some at a time by all threads.
class FinishRows {
 public:
  FinishRows(const HeightGrid& surface, const ReliefProgramOptions& options)
      : cutter_(surface, options.finish.cutter, floor_of(surface), CutterTable::Kind::below, options.beside),
        margin_x_(overrun_nodes(finishing_overrun(options), surface.pitch_x)),
        margin_y_(overrun_nodes(finishing_overrun(options), surface.pitch_y)),
        step_(step_nodes(step_of(options.finish, options, false), surface.pitch_y)),
        threads_(options.threads),
        scratch_(options.threads) {
    const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(surface.rows) - 1 + margin_y_;
    for (std::ptrdiff_t row = -margin_y_; row < last; row += step_) rows_.push_back(row);
    rows_.push_back(last);
  }

  std::size_t count() const { return rows_.size(); }
  std::size_t at_once() const { return std::size_t{16} * threads_; }

  // A row, and the way from its end to the next row.
  struct Row {
    NodeRun along;
    NodeRun over;
  };
  // Rows `first` to `first + rows.size()`, there and back in turn.
  void compute(std::size_t first, std::vector<Row>& rows) {
    for_each_row(rows.size(), threads_,
                 [&](std::size_t i, std::size_t thread) { compute_row(first + i, rows[i], scratch_[thread]); });
  }

 private:
  void compute_row(std::size_t index, Row& row, DroppedCutter::Scratch& scratch) const {
    const auto width = static_cast<std::ptrdiff_t>(cutter_.grid().columns) + 2 * margin_x_;
    const bool is_back = index % 2 == 1;
    NodeRun& along = row.along;
    along = {.column = -margin_x_, .row = rows_[index], .step_x = 1, .step_y = 0, .heights = std::move(along.heights)};
    along.heights.resize(static_cast<std::size_t>(width));
    cutter_.heights(along.row, along.column, along.heights, scratch);
    if (is_back) {
      std::reverse(along.heights.begin(), along.heights.end());
      along.column += width - 1;
      along.step_x = -1;
    }
    NodeRun& over = row.over;
    over = {.column = along.column_at(along.heights.size() - 1), .row = along.row, .step_x = 0, .step_y = 1};
    if (index + 1 == rows_.size()) return;
    over.heights.push_back(along.heights.back());
    for (std::ptrdiff_t next = along.row + 1; next <= rows_[index + 1]; ++next) {
      float height = 0;
      cutter_.heights(next, over.column, {&height, 1}, scratch);
      over.heights.push_back(height);
    }
  }

  DroppedCutter cutter_;
  std::ptrdiff_t margin_x_;
  std::ptrdiff_t margin_y_;
  std::ptrdiff_t step_;
  unsigned threads_;
  std::vector<DroppedCutter::Scratch> scratch_;
  std::vector<std::ptrdiff_t> rows_;
};

}  // namespace

void finish_rows(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                 const std::function<void(double)>& progress) {
  FinishRows work(surface, pass.options());
  pass.set_lattice(lattice);
  RunsBelowTop runs(pass);
  std::vector<FinishRows::Row> rows;
  for (std::size_t first = 0; first < work.count(); first += rows.size()) {
    rows.resize(std::min(work.at_once(), work.count() - first));
    work.compute(first, rows);
    for (const FinishRows::Row& row : rows) {
      runs.cut(row.along);
      if (!row.over.heights.empty()) runs.cut(row.over);
    }
    progress(static_cast<double>(first + rows.size()) / static_cast<double>(work.count()));
  }
}

void finish_spiral(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                   const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const TipMap tips = tips_of(surface, options.finish.cutter, floor_of(surface), finishing_overrun(options), options);
  pass.set_lattice(lattice);
  const Mm step = step_of(options.finish, options, false);
  const std::ptrdiff_t step_x = step_nodes(step, surface.pitch_x);
  const std::ptrdiff_t step_y = step_nodes(step, surface.pitch_y);
  std::ptrdiff_t left = -tips.margin_x;
  std::ptrdiff_t low = -tips.margin_y;
  std::ptrdiff_t right = left + static_cast<std::ptrdiff_t>(tips.columns) - 1;
  std::ptrdiff_t high = low + static_cast<std::ptrdiff_t>(tips.rows) - 1;
  const double turns = static_cast<double>(high - low) / 2 / static_cast<double>(step_y);
  std::ptrdiff_t column = left;
  std::ptrdiff_t row = low;
  RunsBelowTop runs(pass);
  const auto go = [&](std::ptrdiff_t to_column, std::ptrdiff_t to_row) {
    NodeRun run{.column = column, .row = row, .step_x = 0, .step_y = 0};
    if (to_column != column) run.step_x = to_column > column ? 1 : -1;
    if (to_row != row) run.step_y = to_row > row ? 1 : -1;
    while (true) {
      run.heights.push_back(tips.at(column, row));
      if (column == to_column && row == to_row) break;
      column += run.step_x;
      row += run.step_y;
    }
    runs.cut(run);
  };
  // The last turn goes along what is left between the turns before, which is at most a step wide.
  for (double turn = 0; left <= right && low <= high; ++turn) {
    go(right, low);
    go(right, high);
    if (low == high || left == right) break;
    go(left, high);
    const std::ptrdiff_t next = std::min(low + step_y, high);
    go(left, next);
    if (next == high) break;
    left = std::min(left + step_x, right);
    low = next;
    right = std::max(right - step_x, left);
    high = std::max(high - step_y, low);
    if (column < left) go(left, row);
    progress(std::min(1.0, turn / std::max(1.0, turns)));
  }
}

namespace {

// What the finishing cutter leaves, and stock that nobody has cut, on the surface and `rim_x`, `rim_y` nodes around it.
HeightGrid left_by_finishing(const HeightGrid& surface, const ReliefProgramOptions& options, std::ptrdiff_t rim_x,
                             std::ptrdiff_t rim_y) {
  const Cutter& cutter = options.finish.cutter;
  HeightGrid left = surface.with_rim(static_cast<std::size_t>(rim_x), static_cast<std::size_t>(rim_y), 0);
  TipMap tips = tips_of(surface, cutter, floor_of(surface), finishing_overrun(options), options);
  for (float& height : tips.heights) height = -height;
  const HeightGrid upside_down{.columns = tips.columns,
                               .rows = tips.rows,
                               .pitch_x = surface.pitch_x,
                               .pitch_y = surface.pitch_y,
                               .heights = std::move(tips.heights)};
  const DroppedCutter lowest(upside_down, cutter, 0, CutterTable::Kind::sampled);
  std::vector<DroppedCutter::Scratch> scratch(options.threads);
  for_each_row(left.rows, options.threads, [&](std::size_t row, std::size_t thread) {
    const std::span<float> to(&left.heights[row * left.columns], left.columns);
    lowest.heights(static_cast<std::ptrdiff_t>(row) - rim_y + tips.margin_y, tips.margin_x - rim_x, to,
                   scratch[thread]);
    for (float& height : to) height = -height;
  });
  return left;
}

}  // namespace

// The small cutter works where it could take something away that the large one has left. What the large cutter leaves
// is the lowest envelope of its places; the small one dropped onto that is where it would just touch.
void finish_rest(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                 const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const ReliefRest& rest = *options.rest;
  const float floor = floor_of(surface);
  const Mm overrun = rest_overrun(options);
  const std::ptrdiff_t rim_x = nodes_of(rest.tool.cutter.radius + overrun, surface.pitch_x) + 1;
  const std::ptrdiff_t rim_y = nodes_of(rest.tool.cutter.radius + overrun, surface.pitch_y) + 1;
  TipMap touching = tips_of(left_by_finishing(surface, options, rim_x, rim_y), rest.tool.cutter, floor, Mm(0), options);
  touching.margin_x = rim_x;  // it counts from the surface's first node
  touching.margin_y = rim_y;
  const TipMap tips = tips_of(surface, rest.tool.cutter, floor, overrun, options);
  pass.set_lattice(lattice);
  pass.writer().set_feeds({.along = rest.tool.feed, .down = rest.tool.plunge});
  const std::ptrdiff_t step = step_nodes(step_of(rest.tool, options, false), surface.pitch_y);
  const auto least = static_cast<float>(rest.least.value());
  const NodeMask work = nodes_of_work(tips, surface, lattice, Mm(0), DroppedCutter::nothing, options);
  AreaSweep sweep(
      pass,
      area_of(tips, step, options.area.within.empty() ? nodes_of(rest.tool.cutter.radius * 2, surface.pitch_x) : 0),
      [&](auto column, auto row) {
        return touching.at(column, row) - tips.at(column, row) > least && work.at(column, row);
      },
      [&](auto column, auto row) { return tips.at(column, row); },
      [&](auto column, auto row) { return touching.at(column, row); });
  sweep.cut(progress);
}

}  // namespace passo
