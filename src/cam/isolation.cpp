#include "passo/cam/isolation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "copper_gaps.hpp"
#include "edge_grid.hpp"
#include "mill_order.hpp"
#include <fmt/format.h>

#include "passo/cam/mill_program.hpp"

namespace passo {
namespace {

constexpr std::uint32_t most_loops = 2'000;   // around one island
constexpr Nanometres chord_room{3'000};       // beyond the tolerance: arcs, the last digit of the program
constexpr Nanometres notable_ground{10'000};  // ground less than twice as wide is no ground that was left

class IsolationPlanner {
 public:
  IsolationPlanner(const Region& copper, const IsolationOptions& options)
      : copper_(copper), options_(options), islands_(parts_of(copper)) {}

  IsolationPlan plan() {
    std::vector<IsolationCutter> cutters = options_.cutters;
    std::ranges::stable_sort(cutters, [](const auto& a, const auto& b) { return a.width > b.width; });
    widest_ = cutters.front().width;
    for (std::size_t i = 0; i < cutters.size(); ++i) mill_with(cutters[i], i == 0, i + 1 < cutters.size());
    find_narrow_ground(cutters.back());
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
  void mill_with(const IsolationCutter& cutter, bool is_first, bool is_followed);
  Region left_ground() const;
  void find_narrow_ground(const IsolationCutter& finest);

  const Region& copper_;
  const IsolationOptions& options_;
  std::vector<Region> islands_;
  Nanometres widest_;
  Region milled_;  // by the cutters so far; empty after the last
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
    grid_.emplace(*bounds(*within), Nanometres{200'000});
    for (const DrawnRing& ring : within->rings) grid_->add(ring, 0);
    grid_->finish();
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
    EdgeGrid rings(*bounds(Region{parted}), {200'000});
    for (const DrawnRing& ring : parted) rings.add(ring, 0);
    rings.finish();
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
  EdgeGrid grid(bounds(region).value_or(DrawnBox{}), {200'000});
  for (const DrawnRing& ring : region.rings) grid.add(ring, 0);
  grid.finish();
  return grid;
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

void IsolationPlanner::mill_with(const IsolationCutter& cutter, bool is_first, bool is_followed) {
  const Nanometres radius{cutter.width.count / 2};
  const std::uint32_t loops = loops_of(cutter);
  const bool is_bounded = !options_.board.empty();
  Region within;
  if (is_first) {
    if (is_bounded) within = grown(options_.board, options_.clear ? Nanometres{} : radius, options_.tolerance);
  } else {
    const Nanometres reach{std::max(radius.count / 2, radius.count - 2 * notable_ground.count)};
    within = grown(left_ground(), reach, options_.tolerance);
    if (within.empty()) return;
    if (is_bounded) within = common(within, grown(options_.board, radius, options_.tolerance));
  }
  LoopCollector loops_found(is_first && !is_bounded ? nullptr : &within, options_.climb);
  Region outermost;
  for (std::uint32_t k = 0; k < loops; ++k) {
    Region around = grown(copper_, {off(cutter).count + k * step(cutter).count}, options_.tolerance);
    const bool found_any = loops_found.take(around);
    outermost = std::move(around);
    if (!found_any && k > 0) break;
  }
  if (loops_found.ways.empty()) return;

  const EdgeGrid copper_rim = grid_over(grown(copper_, {off(cutter).count - chord_room.count / 2}, options_.tolerance));
  const EdgeGrid outer_rim = grid_over(outermost);
  const auto may_link = [&](DrawnPoint from, DrawnPoint to) {
    constexpr double longest = 3e6;  // nm; a longer way takes more time than lifting
    const double length = distance_nm(from, to);
    const bool is_in_the_open = length > static_cast<double>(cutter.width.count) && !options_.clear;
    if (length > std::max(longest, static_cast<double>(cutter.width.count))) return false;
    if (is_in_the_open && (loops == 1 || !is_first || outer_rim.is_crossed(from, to))) return false;
    return !copper_rim.is_crossed(from, to);
  };
  const ArcFit arcs{.even_chord_nm = static_cast<double>(options_.tolerance.count),
                    .rounded_turn = options_.climb ? -1 : 1};
  MillTool tool{cutter.width, cutter.words, {}};
  tool.runs = order_ways(loops_found.ways, {options_.park, options_.depth, options_.route_steps, arcs, may_link});
  if (is_followed) {
    std::vector<DrawnRing> ways;
    for (const MillRun& run : tool.runs) ways.push_back(chords_of(run, options_.tolerance));
    milled_ = united(milled_, swept(ways, radius, options_.tolerance));
  }
  plan_.mill.tools.push_back(std::move(tool));
}

void IsolationPlanner::find_narrow_ground(const IsolationCutter& finest) {
  const Nanometres around = off(finest);
  // What hangs together when the cutter has gone around all. Two round islands may be apart though no cutter fits
  // between them: it reaches into the gap from both sides.
  const Region kept = grown(grown(copper_, around, options_.tolerance), {-finest.width.count / 2}, options_.tolerance);
  plan_.gaps = find_gaps(islands_, parts_of(kept), {2 * around.count});
  if (plan_.gaps.empty()) return;
  const Region closed = grown(kept, {finest.width.count / 2 - around.count}, options_.tolerance);
  const Nanometres open{options_.tolerance.count};
  const Region ground = grown(grown(subtracted(closed, copper_), {-open.count}), open);
  plan_.unmilled = between_islands(ground, islands_, {3 * open.count});
}

}  // namespace

Nanometres v_cutter_width(Nanometres tip, double angle_degrees, Nanometres depth) {
  const double slope = std::tan(angle_degrees / 360 * std::numbers::pi);
  return {tip.count + std::llround(2 * slope * static_cast<double>(depth.count))};
}

IsolationPlan plan_isolation(const Region& copper, const IsolationOptions& options, Diagnostics& diagnostics) {
  if (copper.empty()) {
    diagnostics.add({.code = "isolation.no-copper",
                     .file = "",
                     .place = {},
                     .message = "there is no copper in these files",
                     .expected = "a copper layer in Gerber, or a DXF drawing of closed lines",
                     .text = ""});
    return {};
  }
  return IsolationPlanner(copper, options).plan();
}

}  // namespace passo
