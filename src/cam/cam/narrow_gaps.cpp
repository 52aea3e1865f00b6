#include "narrow_gaps.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "edge_grid.hpp"
#include "medial_axis.hpp"
#include "ring_groups.hpp"
#include "voronoi_lines.hpp"
#include "way_distance.hpp"

namespace passo {
namespace {

constexpr Nanometres fine_gap_chords{500};
constexpr Nanometres past_the_mouth{20'000};  // ways begin so far outside of the gap, where others have milled

// Copper whose half width is at most `solid` gives nothing, and wider copper keeps `core` on both sides of its middle.
struct TraceGuard {
  double solid_nm;
  double core_nm;
};

// Discs along the middle lines of traces, which cover the copper that must stay.
Region guarded(const Region& island, const std::optional<MedialAxis>& axis, const TraceGuard& guard, Nanometres loss) {
  constexpr double bin = 5'000;  // nm, of the radii
  constexpr double rounding = 2'000;
  if (!axis) return island;
  const double widest = std::max(guard.solid_nm, guard.core_nm + static_cast<double>(loss.count));
  std::map<std::int64_t, std::vector<DrawnRing>> ways;  // by the radius
  for (const MedialPiece& piece : axis->pieces) {
    for (std::size_t i = 0; i + 1 < piece.points.size(); ++i) {
      const MedialPoint& a = piece.points[i];
      const MedialPoint& b = piece.points[i + 1];
      if (std::min(a.clearance, b.clearance) > widest) continue;
      const double half = std::max(a.clearance, b.clearance);
      const double kept = half <= guard.solid_nm ? half + rounding : std::min(half, guard.core_nm);
      const std::int64_t radius = std::llround(std::ceil(kept / bin) * bin);
      ways[half <= guard.solid_nm ? radius : std::llround(kept)].push_back(
          {{{std::llround(a.x)}, {std::llround(a.y)}}, {{std::llround(b.x)}, {std::llround(b.y)}}});
    }
  }
  std::vector<Region> covers;
  for (auto& [radius, lines] : ways) covers.push_back(swept(lines, {radius}, fine_gap_chords));
  return covers.empty() ? Region{} : common(island, united(covers));
}

// The middle lines of traces. The corners of pads have none.
std::vector<std::optional<MedialAxis>> middles_of(const std::vector<Region>& islands) {
  constexpr double trace_like = 2.0;  // radians between the two edges, seen from the middle
  std::vector<std::optional<MedialAxis>> middles;
  for (const Region& island : islands)
    middles.push_back(medial_axis(island, {.least_turn = trace_like, .tolerance_nm = 1'000, .owners = {}}));
  return middles;
}

std::vector<Region> kept_of(const std::vector<Region>& islands, const std::vector<std::optional<MedialAxis>>& middles,
                            const TraceGuard& guard, Nanometres loss) {
  std::vector<Region> kept;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    kept.push_back(
        united(grown(islands[i], {-loss.count}, fine_gap_chords), guarded(islands[i], middles[i], guard, loss)));
    if (kept.back().empty()) kept.back() = islands[i];  // a dot
  }
  return kept;
}

}  // namespace

std::optional<NarrowGapWays> part_narrow_gaps(const std::vector<Region>& islands, const std::vector<Region>& others,
                                              const Region& within, const NarrowGapRules& rules) {
  constexpr double widest_trace = 500'000;  // nm; wider copper gives first
  constexpr Nanometres cell{200'000};
  const auto least = static_cast<double>(rules.least_trace.count);
  const Region copper = gathered(islands);
  const DrawnBox box = bounds(copper).value_or(DrawnBox{});
  const EdgeGrid rims(box, cell, copper.rings);
  const std::vector<std::optional<MedialAxis>> middles = middles_of(islands);
  NarrowGapWays found;
  // Each guard takes from copper that the one before it spared.
  for (const TraceGuard& guard :
       {TraceGuard{std::max(widest_trace, least) / 2, least / 2}, TraceGuard{least / 2, least / 2}}) {
    found.kept = kept_of(islands, middles, guard, rules.loss);
    std::optional<std::vector<DrawnRing>> lines = voronoi_lines(found.kept, box);
    if (!lines) return std::nullopt;
    std::vector<DrawnRing> ways = pieces_near(rims, rules.reach + past_the_mouth, *lines);
    if (!within.empty()) ways = ways_within(ways, within);
    EdgeGrid milled(box, cell);
    for (const DrawnRing& way : found.ways) milled.add_line(way, 0);
    milled.finish();
    ways = pieces_far_from(milled, rules.loss + Nanometres{10'000}, ways);
    std::vector<DrawnRing> stays = gathered(found.kept).rings;
    for (const Region& other : others) stays.insert(stays.end(), other.rings.begin(), other.rings.end());
    std::ranges::move(pieces_far_from(EdgeGrid(box, cell, stays), rules.away, ways), std::back_inserter(found.ways));
  }
  return found;
}

}  // namespace passo
