#include "passo/cam/joined_nets.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "copper_gaps.hpp"
#include "edge_grid.hpp"
#include "ring_groups.hpp"

#include "passo/cam/bulge.hpp"

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

// Tells which places the plan mills.
class MilledPlaces {
 public:
  explicit MilledPlaces(const MillPlan& plan) {
    constexpr Nanometres chords{1'000};
    for (const MillTool& tool : plan.tools) {
      std::vector<DrawnRing> ways;
      for (const MillRun& run : tool.runs) ways.push_back(chords_of(run, chords));
      std::erase_if(ways, [](const DrawnRing& way) { return way.empty(); });
      if (ways.empty()) continue;
      EdgeGrid& grid = tools_.emplace_back(EdgeGrid(box_of(gathered_points(ways)), {200'000}), tool.width).first;
      for (const DrawnRing& way : ways) grid.add_line(way, 0);
      grid.finish();
    }
  }
  bool has(DrawnPoint place) const {
    return std::ranges::any_of(tools_, [&](const auto& tool) {
      return tool.first.nearest(place, static_cast<double>(tool.second.count) / 2).has_value();
    });
  }

 private:
  static DrawnRing gathered_points(const std::vector<DrawnRing>& ways) {
    DrawnRing points;
    for (const DrawnRing& way : ways) points.insert(points.end(), way.begin(), way.end());
    return points;
  }

  std::vector<std::pair<EdgeGrid, Nanometres>> tools_;  // the ways of each, and its width
};

// An island whose corners are at most `step` apart.
Region with_corners(const Region& island, Nanometres step) {
  Region fine;
  for (const DrawnRing& ring : island.rings) {
    DrawnRing& points = fine.rings.emplace_back();
    for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
      const auto count =
          static_cast<std::size_t>(distance_nm(ring[last], ring[i]) / static_cast<double>(step.count)) + 1;
      for (std::size_t k = 1; k <= count; ++k)
        points.push_back(point_along(ring[last], ring[i], 0, static_cast<double>(k) / static_cast<double>(count)));
    }
  }
  return fine;
}

// Finds where islands of the same group are joined.
class GapFinder {
 public:
  GapFinder(const std::vector<Region>& islands, const std::vector<std::size_t>& group)
      : islands_(islands), group_(group), linked_(islands.size()) {}

  // All islands of a group hang together over its gaps.
  std::vector<CopperGap> find(const MillPlan& plan, Nanometres finest) {
    constexpr Nanometres margin{50'000};  // of the cutter's distance from the copper
    const Nanometres reach = finest + margin;
    const MilledPlaces places(plan);
    const auto is_milled = [&](DrawnPoint place) { return places.has(place); };
    // Between two long edges the cutter may have milled the mouths of a gap, where the corners are.
    std::vector<Region> fine(islands_.size());
    std::map<std::size_t, std::size_t> sizes;
    for (const std::size_t number : group_) ++sizes[number];
    for (std::size_t i = 0; i < fine.size(); ++i) {
      if (sizes[group_[i]] > 1) fine[i] = with_corners(islands_[i], {finest.count / 4});
    }
    add(find_gaps(fine, group_, reach, is_milled));
    // What is left between them may be thinner than the steps. The narrowest place is near it.
    if (const std::vector<std::size_t> loose = loose_groups(); !loose.empty()) add(find_gaps(islands_, loose, reach));
    std::ranges::sort(gaps_, {}, [](const CopperGap& gap) { return std::pair(gap.width, gap.at); });
    return std::move(gaps_);
  }

 private:
  void add(const std::vector<CopperGap>& found) {
    for (const CopperGap& gap : found) {
      const auto is_same = [&](const CopperGap& one) { return one.one == gap.one && one.other == gap.other; };
      if (std::ranges::none_of(gaps_, is_same)) gaps_.push_back(gap);
      linked_.join(gap.one, gap.other);
    }
  }
  // The groups that do not hang together yet; other islands get a group of their own. Empty: there are none.
  std::vector<std::size_t> loose_groups() {
    std::map<std::size_t, std::set<std::size_t>> pieces;
    for (std::size_t i = 0; i < group_.size(); ++i) pieces[group_[i]].insert(linked_.of(i));
    std::vector<std::size_t> loose = group_;
    std::size_t next = pieces.empty() ? 0 : pieces.rbegin()->first + 1;
    bool is_any = false;
    for (std::size_t& group : loose) {
      if (pieces[group].size() < 2) {
        group = next++;
      } else {
        is_any = true;
      }
    }
    return is_any ? loose : std::vector<std::size_t>();
  }

  const std::vector<Region>& islands_;
  const std::vector<std::size_t>& group_;
  IndexGroups linked_;
  std::vector<CopperGap> gaps_;
};

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
  if (found.joined > 0) found.gaps = GapFinder(islands, group).find(plan, finest);
  found.names = finder.take_names();
  return found;
}

}  // namespace passo
