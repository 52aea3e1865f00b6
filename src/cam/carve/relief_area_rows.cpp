// Finishing in rows with gaps: on the model, within curves, in one direction only, closer together on slopes, and at an
// angle. Unlike whole rows, these rows need the stock model, because the cutter enters the stock in many places.
#include <algorithm>
#include <cmath>
#include <optional>

#include "node_mask.hpp"
#include "relief_passes.hpp"

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

constexpr float least_work = 0.001F;  // mm

// Clears the marks outside the curves, row by row: between two crossings a row is inside.
void keep_within(const std::vector<std::vector<ReliefPoint>>& curves, const TipMap& map, const NodeLattice& lattice,
                 NodeMask& mask) {
  std::vector<double> crossings;
  for (std::size_t row = 0; row < map.rows; ++row) {
    // If rows are columns in the program, X and Y of the curves are swapped, too.
    const double pitch = lattice.turned ? lattice.pitch_x : lattice.pitch_y;
    const double along_pitch = lattice.turned ? lattice.pitch_y : lattice.pitch_x;
    const double zero = lattice.turned ? lattice.x0 : lattice.y0;
    const double along_zero = lattice.turned ? lattice.y0 : lattice.x0;
    const double at = zero + static_cast<double>(static_cast<std::ptrdiff_t>(row) - map.margin_y) * pitch;
    crossings.clear();
    for (const std::vector<ReliefPoint>& curve : curves) {
      for (std::size_t i = 0; i < curve.size(); ++i) {
        const ReliefPoint& a = curve[i];
        const ReliefPoint& b = curve[(i + 1) % curve.size()];
        const double a_across = (lattice.turned ? a.x : a.y).value();
        const double b_across = (lattice.turned ? b.x : b.y).value();
        if ((a_across <= at) == (b_across <= at)) continue;
        const double a_along = (lattice.turned ? a.y : a.x).value();
        const double b_along = (lattice.turned ? b.y : b.x).value();
        crossings.push_back(a_along + (b_along - a_along) * (at - a_across) / (b_across - a_across));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    for (std::size_t column = 0; column < map.columns; ++column) {
      const double along =
          along_zero + static_cast<double>(static_cast<std::ptrdiff_t>(column) - map.margin_x) * along_pitch;
      while (passed < crossings.size() && crossings[passed] < along) ++passed;
      if (passed % 2 == 0) mask.mark(column, row) = 0;
    }
  }
}

}  // namespace

NodeMask nodes_of_work(const TipMap& map, const HeightGrid& surface, const NodeLattice& lattice, Mm around, float floor,
                       const ReliefProgramOptions& options) {
  NodeMask mask(map);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const bool is_high = map.heights[row * map.columns + column] > floor + least_work;
      mask.mark(column, row) = !options.area.only_on_model || is_high ? 1 : 0;
    }
  }
  if (options.area.only_on_model) mask.widen(nodes_of(around, surface.pitch_x), nodes_of(around, surface.pitch_y));
  if (!options.area.within.empty()) keep_within(options.area.within, map, lattice, mask);
  return mask;
}

NodeMask nodes_of_finishing(const TipMap& map, const HeightGrid& surface, const NodeLattice& lattice,
                            const ReliefProgramOptions& options) {
  NodeMask below(map);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      below.mark(column, row) = map.heights[row * map.columns + column] < -least_work ? 1 : 0;
    }
  }
  below.widen(1, 1);
  NodeMask work =
      nodes_of_work(map, surface, lattice, step_of(options.finish, options, false), floor_of(surface), options);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      if (below.mark(column, row) == 0) work.mark(column, row) = 0;
    }
  }
  return work;
}

namespace {

// The rows that are added between rows, where the surface rises across them.
//
// On a slope, two rows are farther apart along the surface than seen from above, by sqrt(1 + slope²); the height of
// scallops grows with its square. Where scallops would be too high, rows are added midway, and again midway between
// these, until there is a row at each node.
class RowLevels {
 public:
  RowLevels(const TipMap& tips, const HeightGrid& surface, Mm step, const ReliefProgramOptions& options)
      : tips_(tips), nodes_(step_nodes(step, surface.pitch_y)), pitch_(surface.pitch_y.value()) {
    if (!options.rows.has_even_scallops) return;
    const double radius = options.finish.cutter.corner.value();
    const double high = std::min(options.scallop.value(), radius);
    allowed_ = 2 * std::sqrt(high * (2 * radius - high));
    while (parts_ < most_parts && 2 * parts_ <= nodes_) parts_ *= 2;
  }

  std::ptrdiff_t step() const { return nodes_; }
  // The number of parts of a step where the rows are closest: a power of 2.
  std::ptrdiff_t parts() const { return parts_; }

  // The rows that divide each step into this number of parts, without those that already divide it into half as many.
  std::vector<std::ptrdiff_t> rows(std::ptrdiff_t parts) const {
    std::vector<std::ptrdiff_t> all;
    for (std::ptrdiff_t i = 1;; i += 2) {
      const std::ptrdiff_t row = i * nodes_ / parts;
      if (row + 1 >= static_cast<std::ptrdiff_t>(tips_.rows)) return all;
      all.push_back(row - tips_.margin_y);
    }
  }
  // The nodes of these rows at which there is something to cut.
  NodeMask between(const std::vector<std::ptrdiff_t>& rows, std::ptrdiff_t parts) const {
    NodeMask mask(tips_);
    const std::ptrdiff_t apart = (nodes_ + parts - 1) / parts;
    const double gap = static_cast<double>((2 * nodes_ + parts - 1) / parts) * pitch_;  // without these rows
    // Up to this slope the rows are close enough; on level areas the stepover decides.
    constexpr double level = 1e-3;
    const double enough = std::max(level, allowed_ * allowed_ / (gap * gap) - 1);
    for (const std::ptrdiff_t place : rows) {
      const std::ptrdiff_t row = place + tips_.margin_y;
      const std::ptrdiff_t first = std::max<std::ptrdiff_t>(0, row - apart);
      const std::ptrdiff_t end = std::min(static_cast<std::ptrdiff_t>(tips_.rows) - 1, row + apart);
      for (std::size_t column = 0; column < tips_.columns; ++column) {
        bool wants = false;
        for (std::ptrdiff_t i = first; i < end && !wants; ++i) {
          const double square = slope2(column, i);
          wants = square > enough && square < steepest;
        }
        mask.mark(column, static_cast<std::size_t>(row)) = wants ? 1 : 0;
      }
    }
    mask.widen(nodes_ / 2, 0);
    return mask;
  }

 private:
  static constexpr std::ptrdiff_t most_parts = 8;
  static constexpr double steepest = 32;  // 80 degrees

  // The square of the slope from this row of nodes to the next.
  double slope2(std::size_t column, std::ptrdiff_t row) const {
    const std::size_t i = static_cast<std::size_t>(row) * tips_.columns + column;
    const double slope = static_cast<double>(tips_.heights[i + tips_.columns] - tips_.heights[i]) / pitch_;
    return slope * slope;
  }

  const TipMap& tips_;
  std::ptrdiff_t nodes_;
  double pitch_;
  double allowed_ = 0;
  std::ptrdiff_t parts_ = 1;
};

// The direction of travel along columns, for rows that are cut in ascending order: the uncut stock is to the left of a
// row that goes to higher columns, unless rows and columns are swapped.
int direction_of(const ReliefProgramOptions& options, bool is_turned) {
  if (options.rows.direction == RowDirection::there_and_back) return 0;
  return (options.rows.direction == RowDirection::climb) == is_turned ? 1 : -1;
}

}  // namespace

void finish_rows_in_area(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                         const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const Cutter& cutter = options.finish.cutter;
  const TipMap tips = tips_of(surface, cutter, floor_of(surface), finishing_overrun(options), options);
  pass.set_lattice(lattice);
  const NodeMask work = nodes_of_finishing(tips, surface, lattice, options);
  const RowLevels levels(tips, surface, step_of(options.finish, options, false), options);
  const auto free_above = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
    const double x = static_cast<double>(column) * surface.pitch_x.value();
    const double y = static_cast<double>(row) * surface.pitch_y.value();
    const FlatPlace place = lattice.turned ? FlatPlace{y, x} : FlatPlace{x, y};
    // A one-way row begins next to the previous row: there the edge of the cutter touches stock, but not its middle.
    const bool is_beside = options.rows.direction != RowDirection::there_and_back;
    return static_cast<float>(is_beside ? pass.stock()->free_height_inside(place)
                                        : pass.stock()->free_height(place, cutter.radius.value() / 2));
  };
  const Mm gap = gap_of(options, cutter.radius);
  for (std::ptrdiff_t parts = 1; parts <= levels.parts(); parts *= 2) {
    AreaSweep::Area area = area_of(tips, levels.step(), gap.value() > 0 ? nodes_of(gap, surface.pitch_x) : 0);
    area.direction = direction_of(options, lattice.turned);
    std::optional<NodeMask> between;
    if (parts > 1) {
      area.rows = levels.rows(parts);
      if (area.rows.empty()) break;
      between.emplace(levels.between(area.rows, parts));
    }
    AreaSweep sweep(
        pass, area,
        [&](auto column, auto row) { return work.at(column, row) && (!between || between->at(column, row)); },
        [&](auto column, auto row) { return tips.at(column, row); }, free_above);
    sweep.cut([&](double share) { progress(share / static_cast<double>(levels.parts())); });
  }
}

namespace {

// The part of a line through `at` in the direction `along` that lies over the map, with a point for each node.
LevelLine line_over(const TipMap& map, const TipSurface& surface, const FlatPlace& at, const FlatPlace& along) {
  double from = -1e9;
  double to = 1e9;
  const auto clip = [&](double place, double ahead, double low, double high) {
    if (std::abs(ahead) < 1e-12) {
      if (place < low || place > high) to = from;
      return;
    }
    const double a = (low - place) / ahead;
    const double b = (high - place) / ahead;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  };
  const auto edge = [](std::ptrdiff_t margin, std::size_t count, double pitch, bool is_high) {
    return (is_high ? static_cast<double>(count - 1) - static_cast<double>(margin) : -static_cast<double>(margin)) *
           pitch;
  };
  clip(at.x, along.x, edge(map.margin_x, map.columns, surface.pitch_x(), false),
       edge(map.margin_x, map.columns, surface.pitch_x(), true));
  clip(at.y, along.y, edge(map.margin_y, map.rows, surface.pitch_y(), false),
       edge(map.margin_y, map.rows, surface.pitch_y(), true));
  LevelLine line;
  if (!(to > from)) return line;
  const double parts = std::ceil((to - from) / std::min(surface.pitch_x(), surface.pitch_y()));
  for (double i = 0; i <= parts; ++i) {
    const double way = from + (to - from) * i / parts;
    line.points.push_back({at.x + along.x * way, at.y + along.y * way});
  }
  return line;
}

// Rows at an angle, in the order in which they are cut.
class AngledRows {
 public:
  AngledRows(ReliefPass& pass, const NodeLattice& lattice, const TipMap& tips, const TipSurface& surface,
             const NodeMask& work)
      : pass_(pass),
        lattice_(lattice),
        tips_(tips),
        surface_(surface),
        work_(work),
        step_(step_of(pass.options().finish, pass.options(), false).value()) {}

  void cut(const std::function<void(double)>& progress) {
    const double angle = pass_.options().rows.angle.value;
    const FlatPlace along{std::cos(angle), std::sin(angle)};
    const FlatPlace across{-along.y, along.x};
    double low = 1e9;
    double high = -1e9;
    for (const double column : {0.0, static_cast<double>(tips_.columns - 1)}) {
      for (const double row : {0.0, static_cast<double>(tips_.rows - 1)}) {
        const double x = (column - static_cast<double>(tips_.margin_x)) * surface_.pitch_x();
        const double y = (row - static_cast<double>(tips_.margin_y)) * surface_.pitch_y();
        low = std::min(low, x * across.x + y * across.y);
        high = std::max(high, x * across.x + y * across.y);
      }
    }
    const double count = std::max(1.0, std::ceil((high - low) / step_));
    bool is_back = pass_.options().rows.direction == RowDirection::climb;
    for (double i = 0; i <= count; ++i) {
      // The first and the last row would only touch corners of the map.
      const double out = low + (high - low) * std::clamp(i / count, 1e-6, 1 - 1e-6);
      LevelLine line = line_over(tips_, surface_, {across.x * out, across.y * out}, along);
      if (line.points.size() < 2) continue;
      if (is_back) std::reverse(line.points.begin(), line.points.end());
      const auto wants = [&](const FlatPlace& place) { return work_.near(place, surface_); };
      const Mm gap = gap_of(pass_.options(), pass_.options().finish.cutter.radius);
      for (const LevelLine& part : parts_of(line, wants, gap.value(), 0)) cut(part);
      if (pass_.options().rows.direction == RowDirection::there_and_back) is_back = !is_back;
      progress(i / count);
    }
  }

 private:
  LevelPath path_of(const LevelLine& line) const {
    const LevelPathFit fit{.tolerance = pass_.options().tolerance.value(), .has_arcs = false};
    return fit_following_path(line, lowest, surface_, lattice_, fit);
  }

  void cut(const LevelLine& line) {
    const LevelPath path = path_of(line);
    if (path.cuts.empty()) return;
    if (!links_to(line.points.front())) {
      pass_.cut_way(path, surface_, {.is_row = true});
    } else {
      pass_.follow(path, surface_);
    }
    has_begun_ = true;
  }

  // Cuts from the end of a row to the start of the next one, if it is near and everything in between is to be cut.
  bool links_to(const FlatPlace& place) {
    if (!has_begun_ || pass_.options().rows.direction != RowDirection::there_and_back) return false;
    const FlatPlace from = pass_.flat_place();
    const double away = distance_between(from, place);
    if (away > 4 * step_) return false;
    LevelLine link;
    const double parts = std::max(1.0, std::ceil(away / std::min(surface_.pitch_x(), surface_.pitch_y())));
    for (double i = 0; i <= parts; ++i) {
      const FlatPlace here{from.x + (place.x - from.x) * i / parts, from.y + (place.y - from.y) * i / parts};
      if (!work_.near(here, surface_)) return false;
      link.points.push_back(here);
    }
    pass_.follow(path_of(link), surface_);
    return true;
  }

  static constexpr double lowest = -deepest_relief.value();
  ReliefPass& pass_;
  const NodeLattice& lattice_;
  const TipMap& tips_;
  const TipSurface& surface_;
  const NodeMask& work_;
  double step_;
  bool has_begun_ = false;
};

}  // namespace

void finish_rows_at_angle(ReliefPass& pass, const HeightGrid& surface, const NodeLattice& lattice,
                          const std::function<void(double)>& progress) {
  const ReliefProgramOptions& options = pass.options();
  const TipMap tips = tips_of(surface, options.finish.cutter, floor_of(surface), finishing_overrun(options), options);
  const TipSurface tip_surface(tips, surface.pitch_x, surface.pitch_y);
  pass.set_lattice(lattice);
  const NodeMask work = nodes_of_finishing(tips, surface, lattice, options);
  AngledRows(pass, lattice, tips, tip_surface, work).cut(progress);
}

}  // namespace passo
