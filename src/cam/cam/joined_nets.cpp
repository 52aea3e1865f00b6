#include "passo/cam/joined_nets.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "copper_gaps.hpp"
#include "edge_grid.hpp"

namespace passo {
namespace {

class NetFinder {
 public:
  explicit NetFinder(const std::vector<Region>& islands)
      : islands_(islands), rims_(box_of_all(islands), {200'000}), is_net_(islands.size()), names_(islands.size()) {
    for (std::uint32_t i = 0; i < islands.size(); ++i) {
      for (const DrawnRing& ring : islands[i].rings) rims_.add(ring, i);
    }
    rims_.finish();
  }

  void add(const std::vector<NetPlace>& known) {
    std::vector<Region> places;
    for (const NetPlace& place : known) places.push_back({{{place.at}}});
    const std::vector<std::size_t> islands = parts_with(places, islands_);
    for (std::size_t i = 0; i < known.size(); ++i) {
      // The middle of a pad may be its hole.
      std::size_t island = islands[i];
      if (island == islands_.size()) {
        const auto near = rims_.nearest(known[i].at, static_cast<double>(known[i].reach.count));
        if (!near) continue;
        island = rims_.edge(near->edge).owner;
      }
      is_net_[island] = true;
      if (names_[island].empty()) names_[island] = known[i].net;
    }
    if (known.empty()) is_net_.assign(islands_.size(), true);
  }
  bool is_net(std::size_t island) const { return is_net_[island]; }
  // The net of an island: its name, or a word of its own.
  std::string key(std::size_t island) const {
    return names_[island].empty() ? "#" + std::to_string(island) : "=" + names_[island];
  }
  std::vector<std::string> take_names() { return std::move(names_); }

 private:
  static DrawnBox box_of_all(const std::vector<Region>& islands) {
    DrawnRing corners;
    for (const Region& island : islands) {
      const DrawnBox box = bounds(island).value_or(DrawnBox{});
      corners.push_back(box.least);
      corners.push_back(box.most);
    }
    return corners.empty() ? DrawnBox{} : box_of(corners);
  }

  const std::vector<Region>& islands_;
  EdgeGrid rims_;
  std::vector<bool> is_net_;
  std::vector<std::string> names_;
};

// Two islands may be joined elsewhere than where they are nearest, over a third one.
std::vector<CopperGap> without_milled(std::vector<CopperGap> gaps, const MillPlan& plan) {
  constexpr Nanometres chords{1'000};
  if (gaps.empty()) return gaps;
  std::vector<CopperGap> left;
  std::vector<DrawnPoint> places;
  for (const CopperGap& gap : gaps) places.push_back(gap.at);
  DrawnBox box = box_of(places);
  std::vector<bool> is_milled(gaps.size());
  for (const MillTool& tool : plan.tools) {
    std::vector<DrawnRing> ways;
    for (const MillRun& run : tool.runs) ways.push_back(chords_of(run, chords));
    for (const DrawnRing& way : ways) {
      const DrawnBox of_way = box_of(way);
      box = {{std::min(box.least.x, of_way.least.x), std::min(box.least.y, of_way.least.y)},
             {std::max(box.most.x, of_way.most.x), std::max(box.most.y, of_way.most.y)}};
    }
    EdgeGrid grid(box, {200'000});
    for (const DrawnRing& way : ways) grid.add_line(way, 0);
    grid.finish();
    for (std::size_t i = 0; i < gaps.size(); ++i)
      is_milled[i] = is_milled[i] || grid.nearest(gaps[i].at, static_cast<double>(tool.width.count) / 2).has_value();
  }
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (!is_milled[i]) left.push_back(gaps[i]);
  }
  return left.empty() ? gaps : left;
}

}  // namespace

JoinedNets find_joined_nets(const Region& copper, const std::vector<NetPlace>& known, const MillPlan& plan,
                            const IsolationProof& proof, Nanometres finest) {
  const std::vector<Region> islands = parts_of(copper);
  NetFinder finder(islands);
  finder.add(known);
  JoinedNets found;
  struct Piece {
    std::set<std::string> nets;
    std::size_t islands = 0;
    std::size_t others = 0;
  };
  std::map<std::size_t, Piece> pieces;
  std::set<std::string> nets;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    Piece& piece = pieces[proof.pieces[i]];
    ++piece.islands;
    if (finder.is_net(i)) {
      piece.nets.insert(finder.key(i));
      nets.insert(finder.key(i));
    } else {
      ++piece.others;
    }
  }
  found.nets = nets.size();
  // An island of a piece without joined nets is a group of its own.
  std::vector<std::size_t> group;
  std::size_t next = pieces.empty() ? 0 : pieces.rbegin()->first + 1;
  for (const std::size_t piece : proof.pieces) group.push_back(pieces[piece].nets.size() > 1 ? piece : next++);
  std::set<std::string> joined;
  for (const auto& [number, piece] : pieces) {
    if (piece.islands > 1) found.others += piece.others;
    if (piece.nets.size() < 2) continue;
    ++found.groups;
    joined.insert(piece.nets.begin(), piece.nets.end());
  }
  found.joined = joined.size();
  constexpr Nanometres margin{50'000};  // of the cutter's distance from the copper
  if (found.joined > 0) found.gaps = without_milled(find_gaps(islands, group, finest + margin), plan);
  found.names = finder.take_names();
  return found;
}

}  // namespace passo
