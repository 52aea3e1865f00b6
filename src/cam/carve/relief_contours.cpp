// Finishing by contours: at constant heights where the way of the tip is steep, in rows where it is not.
//
// On a slope of the angle `steep` both are as far apart along the slope, so ridges are as high on both sides of it.
#include <algorithm>
#include <cmath>

#include "node_mask.hpp"
#include "relief_passes.hpp"

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

// The nodes from which the map goes up or down steeply.
NodeMask steep_nodes(const TipMap& map, const HeightGrid& surface, Radians steep) {
  NodeMask mask(map);
  const double least = std::tan(steep.value) * std::tan(steep.value);
  const auto slope = [&](std::size_t a, std::size_t b, Mm pitch) {
    return (static_cast<double>(map.heights[b]) - static_cast<double>(map.heights[a])) / pitch.value();
  };
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const std::size_t i = row * map.columns + column;
      double across = 0;
      double up = 0;
      if (column > 0) across = std::max(across, std::abs(slope(i - 1, i, surface.pitch_x)));
      if (column + 1 < map.columns) across = std::max(across, std::abs(slope(i, i + 1, surface.pitch_x)));
      if (row > 0) up = std::max(up, std::abs(slope(i - map.columns, i, surface.pitch_y)));
      if (row + 1 < map.rows) up = std::max(up, std::abs(slope(i, i + map.columns, surface.pitch_y)));
      mask.mark(column, row) = across * across + up * up >= least ? 1 : 0;
    }
  }
  return mask;
}

// The lines of one level, always that one next which begins nearest to where the tool is.
class NearestLines {
 public:
  void add(LevelLine&& line) {
    Kept kept{.line = std::move(line), .low = {}, .high = {}};
    kept.low = kept.high = kept.line.points.front();
    for (const FlatPlace& point : kept.line.points) {
      kept.low = {std::min(kept.low.x, point.x), std::min(kept.low.y, point.y)};
      kept.high = {std::max(kept.high.x, point.x), std::max(kept.high.y, point.y)};
    }
    lines_.push_back(std::move(kept));
  }
  bool empty() const { return lines_.empty(); }
  LevelLine take(const FlatPlace& from) {
    // Of very many lines only some are looked at: those that were found last, and so lie near each other.
    constexpr std::size_t most = 2000;
    const std::size_t begin = lines_.size() > most ? lines_.size() - most : 0;
    std::size_t best = begin;
    for (std::size_t i = begin + 1; i < lines_.size(); ++i) {
      if (lines_[i].away(from) < lines_[best].away(from)) best = i;
    }
    LevelLine line = std::move(lines_[best].line);
    lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(best));
    begin_near(line, from);
    return line;
  }

 private:
  struct Kept {
    LevelLine line;
    FlatPlace low;
    FlatPlace high;

    double away(const FlatPlace& from) const {
      if (!line.is_closed) return distance_between(from, line.points.front());
      const double x = std::max({low.x - from.x, from.x - high.x, 0.0});
      const double y = std::max({low.y - from.y, from.y - high.y, 0.0});
      return std::hypot(x, y);
    }
  };
  std::vector<Kept> lines_;
};

}  // namespace

void finish_contours(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                     const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const Cutter& cutter = options.finish.cutter;
  const float floor = floor_of(surface);
  const TipMap tips = tips_of(surface, cutter, floor, finishing_overrun(options), options);
  const TipSurface tip_surface(tips, surface.pitch_x, surface.pitch_y);
  pass.set_lattice(lattice);
  const Mm step = step_of(options.finish, options, false);
  const std::ptrdiff_t step_x = step_nodes(step, surface.pitch_x);
  const std::ptrdiff_t step_y = step_nodes(step, surface.pitch_y);
  const NodeMask steep = steep_nodes(tips, surface, options.rows.steep);
  NodeMask level = steep;
  level.invert();
  level.widen(step_x, step_y);
  const NodeMask work = nodes_of_work(tips, surface, lattice, step, floor, options);
  const NodeMask below_top = nodes_of_finishing(tips, surface, lattice, options);

  const float top = *std::max_element(tips.heights.begin(), tips.heights.end());
  const float lowest = *std::min_element(tips.heights.begin(), tips.heights.end());
  const double wanted = step.value() * std::tan(options.rows.steep.value);
  const double levels = std::ceil(static_cast<double>(top - lowest) / wanted - 1e-6);
  const double down = levels > 0 ? static_cast<double>(top - lowest) / levels : 0;
  const LevelPathFit fit{.tolerance = options.tolerance.value(), .has_arcs = options.arcs};
  const ReliefPass::WayEntry entry{.near = cutter.radius.value() * 2, .cuts_with_rim = true};
  const Mm gap = gap_of(options, step * 2);
  LevelLines lines(tips, surface.pitch_x, surface.pitch_y);
  for (double i = 1; i <= levels; ++i) {
    const float height = i < levels ? grid_height(Mm(static_cast<double>(top) - down * i)) : lowest;
    NearestLines next;
    lines.trace(height, [&](LevelLine&& line) {
      const auto wants = [&](const FlatPlace& place) {
        return steep.near(place, tip_surface) && work.near(place, tip_surface);
      };
      for (LevelLine& part : parts_of(line, wants, gap.value(), step.value() * 2)) next.add(std::move(part));
    });
    while (!next.empty()) {
      const LevelLine line = next.take(pass.flat_place());
      pass.cut_way(fit_level_path(line, static_cast<double>(height), tip_surface, lattice, fit), tip_surface, entry);
    }
    progress(i / levels * 0.7);
  }
  AreaSweep sweep(
      pass, area_of(tips, step_y, options.area.within.empty() ? nodes_of(cutter.radius, surface.pitch_x) : 0),
      [&](auto column, auto row) { return level.at(column, row) && below_top.at(column, row); },
      [&](auto column, auto row) { return tips.at(column, row); },
      [&](auto column, auto row) {
        const FlatPlace place{static_cast<double>(column) * surface.pitch_x.value(),
                              static_cast<double>(row) * surface.pitch_y.value()};
        return static_cast<float>(pass.stock()->free_height(place, cutter.radius.value() / 2));
      });
  sweep.cut([&](double share) { progress(0.7 + share * 0.3); });
}

}  // namespace passo
