#include "passo/cam/isolation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "copper_gaps.hpp"
#include "edge_grid.hpp"
#include "mill_order.hpp"
#include "narrow_gaps.hpp"
#include "ring_groups.hpp"
#include "thin_line.hpp"
#include "voronoi_lines.hpp"
#include "way_distance.hpp"
#include <fmt/format.h>

#include "passo/cam/mill_program.hpp"

namespace passo {
namespace {

constexpr std::uint32_t most_loops = 2'000;   // around one island
constexpr Nanometres chord_room{3'000};       // beyond the tolerance: arcs, the last digit of the program
constexpr Nanometres frame_away{2'000'000};   // of the frame from the copper
constexpr Nanometres notable_ground{10'000};  // ground less than twice as wide is no ground that was left

// Each as a part of its own.
std::vector<Region> openings_of(const std::vector<Region>& islands) {
  std::vector<Region> openings;
  for (const Region& island : islands) {
    for (std::size_t i = 1; i < island.rings.size(); ++i)
      openings.push_back({{DrawnRing(island.rings[i].rbegin(), island.rings[i].rend())}});
  }
  if (openings.empty()) return openings;
  std::vector<bool> has_island(openings.size() + 1);
  for (const std::size_t opening : parts_with(islands, openings)) has_island[opening] = true;
  std::vector<Region> empty;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (!has_island[i]) empty.push_back(std::move(openings[i]));
  }
  return empty;
}

class IsolationPlanner {
 public:
  IsolationPlanner(const Region& copper, const IsolationOptions& options)
      : copper_(copper), options_(options), islands_(parts_of(copper)), openings_(openings_of(islands_)) {}

  bool find_voronoi_lines() {
    area_ = options_.board;
    if (area_.empty()) area_ = filled({rectangle(*bounds(grown(copper_, frame_away)))});
    std::optional<std::vector<DrawnRing>> lines = voronoi_lines(islands_, *bounds(area_));
    if (lines) lines_ = std::move(*lines);
    return lines.has_value();
  }
  IsolationPlan plan(const WorkProgress& progress) {
    std::vector<IsolationCutter> cutters = options_.cutters;
    std::ranges::stable_sort(cutters, [](const auto& a, const auto& b) { return a.width > b.width; });
    widest_ = cutters.front().width;
    for (std::size_t i = 0; i < cutters.size(); ++i) {
      const WorkProgress milling = progress.part(0, 0.8).stage(i, cutters.size());
      mill_with(cutters[i], i == 0, i + 1 < cutters.size(), milling);
      milling.update(1);
    }
    find_narrow_ground(cutters.back());
    progress.update(1);
    plan_.islands = islands_.size();
    return std::move(plan_);
  }

 private:
  // How far the middle of the cutter stays from the copper, at least.
  Nanometres off(const IsolationCutter& cutter) const {
    return {(cutter.width.count + 1) / 2 + options_.tolerance.count + chord_room.count};
  }
  Nanometres step(const IsolationCutter& cutter) const {
    return {
        std::max<std::int64_t>(1'000, std::llround(static_cast<double>(cutter.width.count) * (1 - options_.overlap)))};
  }
  std::uint32_t loops_of(const IsolationCutter& cutter) const;
  std::vector<CutterWay> loops(const IsolationCutter& cutter, const Region* within, Region& outermost,
                               const WorkProgress& progress) const;
  std::vector<CutterWay> ways_between(const IsolationCutter& cutter, Region& outermost);
  std::vector<CutterWay> ways_in_openings(const IsolationCutter& cutter);
  void mill_with(const IsolationCutter& cutter, bool is_first, bool is_followed, const WorkProgress& progress);
  std::vector<CutterWay> ways_in_gaps(const IsolationCutter& finest);
  Region left_ground() const;
  void find_narrow_ground(const IsolationCutter& finest);

  const Region& copper_;
  const IsolationOptions& options_;
  std::vector<Region> islands_;
  std::vector<Region> openings_;  // within an island, without another island in them; of voronoi: not milled yet
  std::vector<DrawnRing> lines_;  // midway between the islands
  Region area_;                   // of voronoi: the board, or what the frame is around
  Nanometres widest_;
  Nanometres last_off_;              // of the cutter before; 0: there is none
  Region milled_;                    // by the cutters so far; empty after the last
  Region joined_;                    // the copper with the ground that the finest cutter leaves between the islands
  std::vector<DrawnRing> gap_ways_;  // of the finest cutter, through gaps that are narrower
  IsolationPlan plan_;
};

std::uint32_t IsolationPlanner::loops_of(const IsolationCutter& cutter) const {
  if (options_.clear) return most_loops;
  if (!options_.width) return std::min(options_.passes, most_loops);
  const auto beyond = static_cast<double>(options_.width->count - cutter.width.count);
  const double loops = 1 + std::ceil(std::max(0.0, beyond) / static_cast<double>(step(cutter).count));
  return static_cast<std::uint32_t>(std::min(loops, static_cast<double>(most_loops)));
}

// The rings of a region as ways, with the copper to the right for climb milling. A ring that leaves `within` becomes
// the pieces in it.
class LoopCollector {
 public:
  LoopCollector(const Region* within, bool climb) : within_(within), climb_(climb) {
    if (within == nullptr || within->empty()) return;
    grid_.emplace(*bounds(*within), Nanometres{200'000}, within->rings);
  }

  // Whether anything was taken.
  bool take(const Region& region) {
    const std::size_t before = ways.size();
    std::vector<DrawnRing> parted;
    for (const DrawnRing& ring : region.rings) {
      if (within_ == nullptr) {
        add(ring, true);
      } else if (grid_ && is_parted(ring)) {
        parted.push_back(ring);
        parted.back().push_back(ring.front());
      } else if (contains(*within_, ring.front())) {
        add(ring, true);
      }
    }
    if (!parted.empty()) take_pieces(parted);
    return ways.size() != before;
  }

  std::vector<CutterWay> ways;

 private:
  bool is_parted(const DrawnRing& ring) const {
    for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
      if (grid_->is_crossed(ring[last], ring[i])) return true;
    }
    return false;
  }

  // The pieces lie in any direction: the nearest edge of their ring tells which is right.
  void take_pieces(const std::vector<DrawnRing>& parted) {
    const EdgeGrid rings(*bounds(Region{parted}), {200'000}, parted);
    for (DrawnRing& piece : ways_within(parted, *within_)) {
      if (piece.size() < 2) continue;
      const DrawnPoint a = piece[0];
      const DrawnPoint b = piece[1];
      constexpr double rounding = 5;  // nm
      const auto near = rings.nearest({{(a.x.count + b.x.count) / 2}, {(a.y.count + b.y.count) / 2}}, rounding);
      if (near) {
        const EdgeGrid::Edge& edge = rings.edge(near->edge);
        const double along =
            static_cast<double>(edge.to.x.count - edge.from.x.count) * static_cast<double>(b.x.count - a.x.count) +
            static_cast<double>(edge.to.y.count - edge.from.y.count) * static_cast<double>(b.y.count - a.y.count);
        if (along < 0) std::ranges::reverse(piece);
      }
      add(std::move(piece), false);
    }
  }

  void add(DrawnRing ring, bool is_closed) {
    if (climb_) std::ranges::reverse(ring);
    ways.push_back({std::move(ring), is_closed});
  }

  const Region* within_;
  bool climb_;
  std::optional<EdgeGrid> grid_;
};

EdgeGrid grid_over(const Region& region) {
  return {bounds(region).value_or(DrawnBox{}), {200'000}, region.rings};
}

// Ground that the cutters so far left, where it joins two islands or all is to be cleared. Where the widest cutter does
// not fit between two islands, no place is as far from the copper as the cutter is wide.
Region IsolationPlanner::left_ground() const {
  const Nanometres width = std::max(options_.width.value_or(widest_), widest_);
  const Region wanted = options_.clear ? options_.board : grown(copper_, width, options_.tolerance);
  const Region left = subtracted(subtracted(wanted, copper_), milled_);
  const Nanometres open{options_.tolerance.count + notable_ground.count};
  Region notable = grown(grown(left, {-open.count}, options_.tolerance), open, options_.tolerance);
  return options_.clear ? notable : between_islands(notable, islands_, {2 * open.count});
}

// How far the corners of a board are from the box around its copper, at most.
double farthest_corner_nm(const Region& board, const Region& copper) {
  const DrawnBox outer = bounds(board).value_or(DrawnBox{});
  const DrawnBox inner = bounds(copper).value_or(DrawnBox{});
  const auto beyond = [](Nanometres low, Nanometres high) {
    return static_cast<double>(std::max<std::int64_t>({0, low.count, high.count}));
  };
  return std::hypot(beyond(inner.least.x - outer.least.x, outer.most.x - inner.most.x),
                    beyond(inner.least.y - outer.least.y, outer.most.y - inner.most.y));
}

// Of a region that grows again and again, each corner would become two each time. It gets smaller by at most as much,
// so the next loop is a little nearer than one step.
Region thinned(Region region) {
  constexpr double tolerance = 250;  // nm
  for (DrawnRing& ring : region.rings) ring = thinned_ring(ring, tolerance);
  std::erase_if(region.rings, [](const DrawnRing& ring) { return ring.size() < 3; });
  return region;
}

// Around the copper, one around the other. `outermost`: what the last one is around.
std::vector<CutterWay> IsolationPlanner::loops(const IsolationCutter& cutter, const Region* within, Region& outermost,
                                               const WorkProgress& progress) const {
  LoopCollector found(within, options_.climb);
  // The number of loops that clear a board is not known, but the ground that they clear is.
  const double copper_mm2 = options_.clear ? area_mm2(copper_) : 0;
  const double ground_mm2 = options_.clear ? area_mm2(options_.board) - copper_mm2 : 0;
  const double farthest = options_.clear ? farthest_corner_nm(options_.board, copper_) : 0;
  for (std::uint32_t k = 0; k < loops_of(cutter); ++k) {
    outermost = !options_.clear || k == 0
                    ? grown(copper_, {off(cutter).count + k * step(cutter).count}, options_.tolerance)
                    : grown(thinned(std::move(outermost)), step(cutter), options_.tolerance);
    const bool found_any = found.take(outermost);
    // Ground beside the board counts in the area: the loops reach the board's corners last.
    const double reached = static_cast<double>(off(cutter).count + k * step(cutter).count) / std::max(1.0, farthest);
    progress.update(options_.clear ? std::min(reached, (area_mm2(outermost) - copper_mm2) / ground_mm2)
                                   : (k + 1.0) / loops_of(cutter));
    if (!found_any && k > 0) break;
  }
  return std::move(found.ways);
}

// Midway between the islands, where this cutter fits and the one before did not, and beside these ways.
std::vector<CutterWay> IsolationPlanner::ways_between(const IsolationCutter& cutter, Region& outermost) {
  const Region around = grown(copper_, off(cutter), options_.tolerance);
  const Region within = options_.board.empty() ? area_ : grown(area_, {cutter.width.count / 2}, options_.tolerance);
  Region free = subtracted(within, around);
  if (last_off_.count > 0) free = common(free, grown(copper_, last_off_, options_.tolerance));
  std::vector<DrawnRing> lines = ways_within(lines_, free);
  LoopCollector beside(&within, options_.climb);
  for (std::uint32_t k = 1; k < loops_of(cutter); ++k) {
    outermost = subtracted(swept(lines, {k * step(cutter).count}, options_.tolerance), around);
    if (!beside.take(outermost)) break;
  }
  std::vector<CutterWay> ways = std::move(beside.ways);
  for (DrawnRing& line : lines) {
    if (line.size() > 1) ways.push_back({.points = std::move(line), .is_closed = false, .may_be_turned = true});
  }
  if (options_.board.empty() && last_off_.count == 0) {
    for (const DrawnRing& ring : area_.rings) ways.push_back({.points = ring});
  }
  std::ranges::move(ways_in_openings(cutter), std::back_inserter(ways));
  return ways;
}

// Loops within the openings into which no cutter before this one came.
std::vector<CutterWay> IsolationPlanner::ways_in_openings(const IsolationCutter& cutter) {
  std::vector<CutterWay> ways;
  std::vector<Region> left;
  for (Region& opening : openings_) {
    LoopCollector found(nullptr, options_.climb);
    for (std::uint32_t k = 0; k < loops_of(cutter); ++k) {
      // What lies inside, as holes of the copper around.
      Region inside = grown(opening, {-off(cutter).count - k * step(cutter).count}, options_.tolerance);
      for (DrawnRing& ring : inside.rings) std::ranges::reverse(ring);
      if (!found.take(inside)) break;
    }
    if (found.ways.empty()) left.push_back(std::move(opening));
    std::ranges::move(found.ways, std::back_inserter(ways));
  }
  openings_ = std::move(left);
  return ways;
}

// Through the gaps into which the finest cutter does not fit.
std::vector<CutterWay> IsolationPlanner::ways_in_gaps(const IsolationCutter& finest) {
  const Nanometres around = off(finest);
  const Nanometres radius{(finest.width.count + 1) / 2};
  // What hangs together when the cutter has gone around all. Two round islands may be apart though no cutter fits
  // between them: it reaches into the gap from both sides.
  joined_ = grown(grown(copper_, around, options_.tolerance), {-radius.count}, options_.tolerance);
  if (options_.allowed_loss.count <= 0) return {};
  std::vector<std::size_t> narrow;  // islands beside a gap
  for (const CopperGap& gap : find_gaps(islands_, parts_with(islands_, parts_of(joined_)), {2 * around.count})) {
    narrow.push_back(gap.one);
    narrow.push_back(gap.other);
  }
  if (narrow.empty()) return {};
  std::ranges::sort(narrow);
  narrow.erase(std::unique(narrow.begin(), narrow.end()), narrow.end());
  std::vector<Region> beside;
  std::vector<Region> others;
  for (std::size_t i = 0; i < islands_.size(); ++i)
    (std::ranges::binary_search(narrow, i) ? beside : others).push_back(islands_[i]);
  Region within = options_.board;
  if (!within.empty()) within = grown(within, radius, options_.tolerance);
  std::optional<NarrowGapWays> found = part_narrow_gaps(
      beside, others, within, {radius + chord_room, around, options_.allowed_loss, options_.least_trace});
  if (!found || found->ways.empty()) return {};
  plan_.kept = islands_;
  for (std::size_t i = 0; i < narrow.size(); ++i) plan_.kept[narrow[i]] = std::move(found->kept[i]);
  std::vector<CutterWay> ways;
  gap_ways_ = std::move(found->ways);
  for (const DrawnRing& way : gap_ways_)
    ways.push_back({.points = way, .is_closed = false, .may_be_turned = true, .is_exact = true});
  return ways;
}

void IsolationPlanner::mill_with(const IsolationCutter& cutter, bool is_first, bool is_followed,
                                 const WorkProgress& progress) {
  const Nanometres radius{cutter.width.count / 2};
  const bool is_bounded = !options_.board.empty();
  Region within;
  bool fits = true;
  if (is_first) {
    if (is_bounded) within = grown(options_.board, options_.clear ? Nanometres{} : radius, options_.tolerance);
  } else if (!options_.voronoi) {
    const Nanometres reach{std::max(radius.count / 2, radius.count - 2 * notable_ground.count)};
    within = grown(left_ground(), reach, options_.tolerance);
    fits = !within.empty();
    if (is_bounded) within = common(within, grown(options_.board, radius, options_.tolerance));
  }
  Region outermost;
  std::vector<CutterWay> ways;
  if (options_.voronoi) {
    ways = ways_between(cutter, outermost);
  } else if (fits) {
    ways = loops(cutter, is_first && !is_bounded ? nullptr : &within, outermost, progress.part(0, 0.5));
  }
  if (!is_followed) std::ranges::move(ways_in_gaps(cutter), std::back_inserter(ways));
  last_off_ = off(cutter);
  if (ways.empty()) return;

  const EdgeGrid copper_rim = grid_over(grown(copper_, {off(cutter).count - chord_room.count / 2}, options_.tolerance));
  const EdgeGrid stays = grid_over(plan_.kept.empty() ? copper_ : gathered(plan_.kept));
  constexpr Nanometres link_room{2'500};  // more than the proof allows for, less than the loops keep
  const Nanometres link_away = Nanometres{(cutter.width.count + 1) / 2} + link_room;
  const EdgeGrid outer_rim = grid_over(outermost);
  const auto may_link = [&](DrawnPoint from, DrawnPoint to) {
    constexpr double longest = 3e6;  // nm; a longer way takes more time than lifting
    const double length = distance_nm(from, to);
    const bool is_in_the_open = length > static_cast<double>(cutter.width.count) && !options_.clear;
    if (length > std::max(longest, static_cast<double>(cutter.width.count))) return false;
    if (is_in_the_open && (loops_of(cutter) == 1 || !is_first || outer_rim.is_crossed(from, to))) return false;
    return from == to || !(copper_rim.is_crossed(from, to) || is_near(stays, link_away, from, to));
  };
  const ArcFit arcs{.even_chord_nm = static_cast<double>(options_.tolerance.count),
                    .rounded_turn = options_.climb ? -1 : 1};
  MillTool tool{cutter.width, cutter.words, {}};
  const DrawnPoint from = end_of(plan_.mill, options_.park, options_.link);
  const std::optional<DrawnPoint> to = options_.link.to(options_.park, !is_followed);
  tool.runs = order_ways(ways, {from, to, options_.depth, options_.route_steps, arcs, may_link}, progress.part(0.5, 1));
  if (is_followed && !options_.voronoi) {
    std::vector<DrawnRing> chords;
    for (const MillRun& run : tool.runs) chords.push_back(chords_of(run, options_.tolerance));
    milled_ = united(milled_, swept(chords, radius, options_.tolerance));
  }
  plan_.mill.tools.push_back(std::move(tool));
}

void IsolationPlanner::find_narrow_ground(const IsolationCutter& finest) {
  const Nanometres around = off(finest);
  const Nanometres radius{(finest.width.count + 1) / 2};
  Region narrow;
  for (const Region& opening : openings_) {
    if (grown(opening, {-notable_ground.count}).empty()) continue;
    const Region reached = grown(grown(opening, {-around.count}), around);
    if (area_mm2(reached) > 0.5 * area_mm2(opening)) continue;
    plan_.narrow_openings.push_back(opening.rings.front().front());
    narrow.rings.push_back(opening.rings.front());
  }
  plan_.unmilled = narrow;
  Region left = std::move(joined_);
  if (!gap_ways_.empty()) left = subtracted(left, swept(gap_ways_, {radius.count}));
  const std::vector<Region>& places = plan_.kept.empty() ? islands_ : plan_.kept;  // they have points that stay
  plan_.gaps = find_gaps(islands_, parts_with(places, parts_of(left)), {2 * around.count});
  if (plan_.gaps.empty()) return;
  const Region closed = grown(left, {radius.count - around.count}, options_.tolerance);
  const Nanometres open{options_.tolerance.count};
  const Region ground = grown(grown(subtracted(closed, copper_), {-open.count}), open);
  plan_.unmilled = united(narrow, between_islands(ground, islands_, {3 * open.count}));
}

}  // namespace

Nanometres v_cutter_width(Nanometres tip, double angle_degrees, Nanometres depth) {
  const double slope = std::tan(angle_degrees / 360 * std::numbers::pi);
  return {tip.count + std::llround(2 * slope * static_cast<double>(depth.count))};
}

IsolationPlan plan_isolation(const Region& copper, const IsolationOptions& options, Diagnostics& diagnostics,
                             const WorkProgress& progress) {
  if (copper.empty()) {
    diagnostics.add({.code = "isolation.no-copper",
                     .file = "",
                     .place = {},
                     .message = "there is no copper in these files",
                     .expected = "a copper layer in Gerber, or a DXF drawing of closed lines",
                     .text = ""});
    return {};
  }
  IsolationPlanner planner(copper, options);
  if (options.voronoi && !planner.find_voronoi_lines()) {
    diagnostics.add({.code = "isolation.too-wide",
                     .file = "",
                     .place = {},
                     .message = "the board is too large for paths midway between its islands",
                     .expected = "a sum of width and height of at most 1 m",
                     .text = ""});
    return {};
  }
  return planner.plan(progress);
}

}  // namespace passo
