#include "passo/cam/isolation_proof.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "edge_grid.hpp"

#include "passo/cam/mill_program.hpp"

namespace passo {
namespace {

// The copper that is left on a board much wider than the ways: a ring of what is milled, seen from the other side.
Region left_around(const Region& milled) {
  constexpr std::int64_t wide = 10'000'000;  // nm
  DrawnBox box = bounds(milled).value_or(DrawnBox{});
  box.least = {{box.least.x.count - wide}, {box.least.y.count - wide}};
  box.most = {{box.most.x.count + wide}, {box.most.y.count + wide}};
  Region left{{rectangle(box)}};
  for (const DrawnRing& ring : milled.rings) {
    left.rings.push_back(ring);
    std::ranges::reverse(left.rings.back());
  }
  return left;
}

// Whether any place is in both. Where no rims meet, a part of one lies in the other as a whole, or not at all.
bool have_common(const Region& a, const Region& b, const std::vector<Region>& parts_of_a) {
  const std::optional<DrawnBox> box = bounds(a);
  if (!box) return false;
  EdgeGrid rims(*box, {200'000});
  for (const DrawnRing& ring : a.rings) rims.add(ring, 0);
  rims.finish();
  for (const DrawnRing& ring : b.rings) {
    for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
      if (rims.is_crossed(ring[last], ring[i])) return true;
    }
  }
  const std::vector<Region> parts_of_b = parts_of(b);
  const auto lie_in = [](const std::vector<Region>& parts, const std::vector<Region>& others) {
    return std::ranges::any_of(parts_with(parts, others), [&](std::size_t i) { return i < others.size(); });
  };
  return lie_in(parts_of_a, parts_of_b) || lie_in(parts_of_b, parts_of_a);
}

}  // namespace

IsolationProof prove_isolation(const Region& copper, const MillPlan& plan, const Region& board) {
  constexpr Nanometres of_arcs{500};    // chords of the ways
  constexpr Nanometres of_discs{1000};  // chords of the discs
  std::vector<Region> by_tool;
  for (const MillTool& tool : plan.tools) {
    std::vector<DrawnRing> ways;
    for (const MillRun& run : tool.runs) ways.push_back(chords_of(run, of_arcs));
    const Nanometres radius{(tool.width.count + 1) / 2 + most_rounding.count + of_arcs.count + of_discs.count};
    by_tool.push_back(swept(ways, radius, of_discs));
  }
  const Region milled = by_tool.size() == 1 ? std::move(by_tool.front()) : united(by_tool);
  const std::vector<Region> islands = parts_of(copper);
  const std::vector<Region> left = parts_of(board.empty() ? left_around(milled) : subtracted(board, milled));

  IsolationProof proof;
  proof.copper_mm2 = area_mm2(copper);
  proof.milled_mm2 = area_mm2(milled);
  if (have_common(copper, milled, islands)) proof.lost_mm2 = area_mm2(common(copper, milled));
  proof.islands = islands.size();
  std::vector<std::size_t> islands_in(left.size() + 1);
  for (const std::size_t part : parts_with(islands, left)) ++islands_in[part];
  islands_in.pop_back();
  for (const std::size_t count : islands_in) {
    if (count < 2) continue;
    proof.joined += count;
    ++proof.groups;
  }
  return proof;
}

}  // namespace passo
