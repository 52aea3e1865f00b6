// The pencil pass: along the inner edges of a relief, where the last cutter touches two faces at once. Rows and
// contours leave the most material there, because passes on both sides of an edge are farthest from the surface.
#include <algorithm>
#include <cmath>

#include "relief_passes.hpp"
#include "valley_lines.hpp"

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

// The line with an end nearest to the tool's position, in the direction that begins at this end.
LevelLine take_nearest(std::vector<LevelLine>& lines, const FlatPlace& from) {
  std::size_t best = 0;
  double least = 1e9;
  bool is_back = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double at_front = distance_between(from, lines[i].points.front());
    const double at_back = distance_between(from, lines[i].points.back());
    if (std::min(at_front, at_back) >= least) continue;
    least = std::min(at_front, at_back);
    best = i;
    is_back = at_back < at_front;
  }
  LevelLine line = std::move(lines[best]);
  lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(best));
  if (is_back) std::reverse(line.points.begin(), line.points.end());
  begin_near(line, from);
  return line;
}

}  // namespace

void finish_pencil(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                   const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const ReliefTool& tool = options.rest ? options.rest->tool : options.finish;
  const Mm overrun = options.rest ? rest_overrun(options) : finishing_overrun(options);
  const TipMap tips = tips_of(surface, tool.cutter, floor_of(surface), overrun, options);
  const TipSurface tip_surface(tips, surface.pitch_x, surface.pitch_y);
  pass.set_lattice(lattice);
  const NodeMask work = nodes_of_finishing(tips, surface, lattice, options);
  std::vector<LevelLine> lines =
      valley_lines(tip_surface, {.least_length = tool.cutter.radius.value(),
                                 .wants = [&](const FlatPlace& place) { return work.near(place, tip_surface); }});
  progress(0.5);
  // The patches of the map hang over a valley between two nodes, so their bottom goes up and down along it. The path
  // does not follow that.
  const double uneven = std::min(surface.pitch_x, surface.pitch_y).value() / 4;
  const LevelPathFit fit{.tolerance = options.tolerance.value() + uneven, .has_arcs = false, .places_of_cell = 8};
  const ReliefPass::WayEntry entry{.near = gap_of(options, tool.cutter.radius * 2).value(), .is_row = true};
  const auto all = static_cast<double>(lines.size());
  while (!lines.empty()) {
    const LevelLine line = take_nearest(lines, pass.flat_place());
    pass.cut_way(fit_following_path(line, -deepest_relief.value(), tip_surface, lattice, fit), tip_surface, entry);
    progress(1 - static_cast<double>(lines.size()) / all / 2);
  }
}

}  // namespace passo
