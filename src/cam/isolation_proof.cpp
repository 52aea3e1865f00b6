#include "passo/cam/isolation_proof.hpp"

#include <algorithm>
#include <vector>

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
  proof.lost_mm2 = area_mm2(common(copper, milled));
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
