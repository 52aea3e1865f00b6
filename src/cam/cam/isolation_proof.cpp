#include "passo/cam/isolation_proof.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "edge_grid.hpp"
#include "ring_groups.hpp"

#include "passo/cam/bulge.hpp"
#include "passo/cam/mill_program.hpp"

namespace passo {
namespace {

constexpr Nanometres of_arcs{500};    // chords of the ways
constexpr Nanometres of_discs{1000};  // chords of the discs

// What one cutter goes along, and what a disc sweeps there.
struct SweptWay {
  DrawnRing way;
  Nanometres radius;
  DrawnBox box;  // of what is swept
};

std::vector<SweptWay> swept_ways(const MillPlan& plan) {
  std::vector<SweptWay> ways;
  for (const MillTool& tool : plan.tools) {
    const Nanometres radius{(tool.width.count + 1) / 2 + most_rounding.count + of_arcs.count + of_discs.count};
    for (const MillRun& run : tool.runs) {
      SweptWay& one = ways.emplace_back(SweptWay{chords_of(run, of_arcs), radius, {}});
      one.box = box_of(one.way);
      one.box.least = {one.box.least.x - radius, one.box.least.y - radius};
      one.box.most = {one.box.most.x + radius, one.box.most.y + radius};
    }
  }
  return ways;
}

// The pieces of a way of which something is swept between two X.
void add_pieces(const SweptWay& swept, Nanometres low, Nanometres high, std::vector<DrawnRing>& pieces) {
  const auto is_near = [&](DrawnPoint a, DrawnPoint b) {
    return std::max(a.x, b.x) + swept.radius >= low && std::min(a.x, b.x) - swept.radius <= high;
  };
  if (swept.box.most.x < low || swept.box.least.x > high) return;
  if (swept.box.least.x >= low && swept.box.most.x <= high) return pieces.push_back(swept.way);
  DrawnRing piece;
  for (std::size_t i = 0; i + 1 < swept.way.size(); ++i) {
    if (is_near(swept.way[i], swept.way[i + 1])) {
      if (piece.empty()) piece.push_back(swept.way[i]);
      piece.push_back(swept.way[i + 1]);
    } else if (!piece.empty()) {
      pieces.push_back(std::exchange(piece, {}));
    }
  }
  if (swept.way.size() == 1) piece = swept.way;
  if (!piece.empty()) pieces.push_back(std::move(piece));
}

// A board's strip from one X to another, and what is left of it.
struct Strip {
  DrawnBox box;
  std::vector<Region> left = {};
};

// The strips of all that a plan mills and of what lies around. The sweep of a board takes as long as its corners times
// the edges beside them: strips of a large board together take a fraction of that.
std::vector<Strip> strips_of(const std::vector<SweptWay>& ways, const DrawnBox& around) {
  constexpr std::size_t corners_of_strip = 8'000;
  constexpr std::size_t most_strips = 100;
  std::vector<std::int64_t> places;
  for (const SweptWay& one : ways) {
    for (const DrawnPoint& point : one.way) places.push_back(point.x.count);
  }
  const std::size_t count = std::clamp<std::size_t>(places.size() / corners_of_strip, 1, most_strips);
  std::vector<Strip> strips;
  Nanometres from = around.least.x;
  for (std::size_t i = 1; i <= count; ++i) {
    const auto place = places.begin() + static_cast<std::ptrdiff_t>(i * places.size() / count);
    Nanometres to = around.most.x;
    if (i < count) {
      std::nth_element(places.begin(), place, places.end());
      to = {*place};
    }
    if (to <= from) continue;
    strips.push_back({{{from, around.least.y}, {to, around.most.y}}});
    from = to;
  }
  return strips;
}

// What is milled within a strip, and beside it as far as the pieces of the ways go.
Region milled_in(const Strip& strip, const std::vector<SweptWay>& ways) {
  std::vector<Region> by_radius;
  std::vector<DrawnRing> pieces;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    add_pieces(ways[i], strip.box.least.x, strip.box.most.x, pieces);
    const bool is_last = i + 1 == ways.size() || ways[i + 1].radius != ways[i].radius;
    if (is_last && !pieces.empty()) by_radius.push_back(swept(std::exchange(pieces, {}), ways[i].radius, of_discs));
  }
  return by_radius.size() == 1 ? std::move(by_radius.front()) : united(by_radius);
}

// All that is milled lies within the face: its rings, seen from the other side.
Region left_around(Region face, const Region& milled) {
  for (const DrawnRing& ring : milled.rings) {
    face.rings.push_back(ring);
    std::ranges::reverse(face.rings.back());
  }
  return face;
}

// The layer, to be compared with what is milled.
class ProvedLayer {
 public:
  explicit ProvedLayer(const Region& copper)
      : copper_(copper),
        islands_(parts_of(copper)),
        rims_(bounds(copper).value_or(DrawnBox{}), {200'000}, copper.rings) {}
  const std::vector<Region>& islands() const { return islands_; }

  // Whether any place is in both. Where no rims meet, a part of one lies in the other as a whole, or not at all.
  bool has_common(const Region& milled) const {
    for (const DrawnRing& ring : milled.rings) {
      for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
        if (rims_.is_crossed(ring[last], ring[i])) return true;
      }
    }
    const std::vector<Region> parts = parts_of(milled);
    const auto lie_in = [](const std::vector<Region>& some, const std::vector<Region>& others) {
      return std::ranges::any_of(parts_with(some, others), [&](std::size_t i) { return i < others.size(); });
    };
    return lie_in(islands_, parts) || lie_in(parts, islands_);
  }
  Region common_with(const Region& milled, const Strip& strip) const {
    return common(common(copper_, Region{{rectangle(strip.box)}}), milled);
  }
  // How far from the rim of the copper what is lost lies, at most. A way across a pad has its corners on the rim, so
  // places along the edges are measured, too.
  Nanometres deepest(const Region& lost) const {
    constexpr double reach = 1e6;  // nm
    constexpr double apart = 10'000;
    double deepest = 0;
    for (const DrawnRing& ring : lost.rings) {
      for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
        const auto count = static_cast<std::size_t>(std::ceil(distance_nm(ring[last], ring[i]) / apart));
        for (std::size_t k = 1; k <= count; ++k) {
          const double share = static_cast<double>(k) / static_cast<double>(count);
          const auto near = rims_.nearest(point_along(ring[last], ring[i], 0, share), reach);
          deepest = std::max(deepest, near ? near->distance_nm : reach);
        }
      }
    }
    return {std::llround(deepest)};
  }

 private:
  const Region& copper_;
  std::vector<Region> islands_;
  EdgeGrid rims_;
};

struct SeamEdge {
  std::int64_t low;
  std::int64_t high;
  std::size_t part;
};

// The edges of the parts at an X, from low to high.
std::vector<SeamEdge> edges_at(Nanometres x, const std::vector<Region>& parts) {
  std::vector<SeamEdge> edges;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (const DrawnRing& ring : parts[part].rings) {
      for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
        if (ring[last].x != x || ring[i].x != x) continue;
        const auto [low, high] = std::minmax(ring[last].y.count, ring[i].y.count);
        edges.push_back({low, high, part});
      }
    }
  }
  std::ranges::sort(edges, {}, &SeamEdge::low);
  return edges;
}

// Joins the parts of two strips that go on beyond the seam between them. Their numbers begin at `first` and at
// `second`.
void join_at_seam(const Strip& a, std::size_t first, const Strip& b, std::size_t second, IndexGroups& groups) {
  const std::vector<SeamEdge> of_a = edges_at(a.box.most.x, a.left);
  const std::vector<SeamEdge> of_b = edges_at(a.box.most.x, b.left);
  for (std::size_t i = 0, k = 0; i < of_a.size() && k < of_b.size();) {
    if (std::max(of_a[i].low, of_b[k].low) < std::min(of_a[i].high, of_b[k].high))
      groups.join(first + of_a[i].part, second + of_b[k].part);
    if (of_a[i].high < of_b[k].high) {
      ++i;
    } else {
      ++k;
    }
  }
}

// The pieces of copper in which islands are left.
struct LeftPieces {
  std::vector<std::size_t> of_island = {};
  std::vector<std::size_t> broken = {};
};

// An island, or what must stay of it.
struct ProvedIsland {
  const Region* stays;
  bool is_told_by_first;  // by the piece in which its first point lies
};

// Corners of an island, in all of its parts but the tiniest.
std::vector<DrawnPoint> places_on(const ProvedIsland& island) {
  constexpr double tiniest = 0.002;  // mm2
  constexpr std::size_t most_of_ring = 8;
  if (island.stays->empty()) return {};
  std::vector<DrawnPoint> places = {island.stays->rings.front().front()};
  if (island.is_told_by_first) return places;
  for (const DrawnRing& ring : island.stays->rings) {
    if (area_mm2(ring) < tiniest) continue;
    const std::size_t step = (ring.size() + most_of_ring - 1) / most_of_ring;
    for (std::size_t i = 0; i < ring.size(); i += step) places.push_back(ring[i]);
  }
  return places;
}

LeftPieces pieces_of(const std::vector<ProvedIsland>& islands, const std::vector<Strip>& strips) {
  std::vector<std::size_t> firsts;
  std::size_t count = 0;
  for (const Strip& strip : strips) {
    firsts.push_back(count);
    count += strip.left.size();
  }
  IndexGroups groups(count);
  for (std::size_t i = 0; i + 1 < strips.size(); ++i)
    join_at_seam(strips[i], firsts[i], strips[i + 1], firsts[i + 1], groups);
  std::vector<std::vector<std::size_t>> found(islands.size());
  std::vector<std::vector<DrawnPoint>> places;
  for (const ProvedIsland& island : islands) places.push_back(places_on(island));
  for (std::size_t i = 0; i < strips.size(); ++i) {
    std::vector<Region> here;
    std::vector<std::size_t> owners;
    for (std::size_t island = 0; island < islands.size(); ++island) {
      for (const DrawnPoint& point : places[island]) {
        if (point.x < strips[i].box.least.x || (point.x >= strips[i].box.most.x && i + 1 < strips.size())) continue;
        here.push_back({{{point}}});
        owners.push_back(island);
      }
    }
    const std::vector<std::size_t> parts = parts_with(here, strips[i].left);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (parts[k] < strips[i].left.size()) found[owners[k]].push_back(groups.of(firsts[i] + parts[k]));
    }
  }
  LeftPieces pieces;
  for (std::size_t island = 0; island < islands.size(); ++island) {
    std::vector<std::size_t>& of_one = found[island];
    // An island that the edge of the board parts is not milled apart.
    const bool is_within = of_one.size() == places[island].size();
    std::ranges::sort(of_one);
    pieces.of_island.push_back(of_one.empty() ? count + island : of_one.front());
    if (is_within && !of_one.empty() && of_one.front() != of_one.back()) pieces.broken.push_back(island);
  }
  return pieces;
}

}  // namespace

IsolationProof prove_isolation(const Region& copper, const MillPlan& plan, const Region& board,
                               const WorkProgress& progress, const std::vector<Region>& kept) {
  constexpr Nanometres beyond{10'000'000};  // around all, where copper goes on without end
  const std::vector<SweptWay> ways = swept_ways(plan);
  const ProvedLayer layer(copper);
  const Region all_kept = gathered(kept);
  const ProvedLayer kept_layer(all_kept);
  std::optional<DrawnBox> around = bounds(copper);
  for (const SweptWay& one : ways)
    around = around ? DrawnBox{{std::min(around->least.x, one.box.least.x), std::min(around->least.y, one.box.least.y)},
                               {std::max(around->most.x, one.box.most.x), std::max(around->most.y, one.box.most.y)}}
                    : one.box;
  IsolationProof proof;
  proof.copper_mm2 = area_mm2(copper);
  proof.islands = layer.islands().size();
  if (!around) return proof;
  around->least = {around->least.x - beyond, around->least.y - beyond};
  around->most = {around->most.x + beyond, around->most.y + beyond};

  std::vector<Strip> strips = strips_of(ways, *around);
  std::size_t proved = 0;
  for (Strip& strip : strips) {
    const Region face{{rectangle(strip.box)}};
    const Region milled = milled_in(strip, ways);
    const Region left = strips.size() == 1 ? left_around(face, milled) : subtracted(face, milled);
    proof.milled_mm2 += area_mm2(face) - area_mm2(left);
    if (layer.has_common(milled)) {
      const Region lost = layer.common_with(milled, strip);
      proof.lost_mm2 += area_mm2(lost);
      proof.deepest = std::max(proof.deepest, layer.deepest(lost));
      if (!kept.empty() && kept_layer.has_common(milled))
        proof.damage_mm2 += area_mm2(kept_layer.common_with(milled, strip));
    }
    strip.left = parts_of(board.empty() ? left : common(board, left));
    progress.stage(proved++, strips.size()).update(1);
  }
  if (kept.empty()) proof.damage_mm2 = proof.lost_mm2;
  std::vector<ProvedIsland> islands;
  for (std::size_t i = 0; i < layer.islands().size(); ++i) {
    const Region& island = layer.islands()[i];
    const Region& stays = kept.empty() ? island : kept[i];
    const bool is_within = board.empty() || contains(board, island.rings.front().front());
    islands.push_back({&stays, is_within && stays.rings == island.rings});
  }
  LeftPieces found = pieces_of(islands, strips);
  std::vector<std::size_t> pieces = found.of_island;
  proof.pieces = std::move(found.of_island);
  proof.broken = std::move(found.broken);
  std::ranges::sort(pieces);
  for (auto at = pieces.begin(); at != pieces.end();) {
    const auto end = std::upper_bound(at, pieces.end(), *at);
    if (end - at > 1) {
      proof.joined += static_cast<std::size_t>(end - at);
      ++proof.groups;
    }
    at = end;
  }
  return proof;
}

}  // namespace passo
