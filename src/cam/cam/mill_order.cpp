#include "mill_order.hpp"

#include <algorithm>
#include <limits>

#include "piece_order.hpp"
#include "place_tree.hpp"

#include "passo/cam/route.hpp"

namespace passo {
namespace {

// A way, and the index of the point where the cutter comes to it.
struct EnteredWay {
  std::uint32_t way;
  std::uint32_t entry;
};
using Chain = std::vector<EnteredWay>;  // ways between which the cutter stays down

class WayOrderer {
 public:
  WayOrderer(const std::vector<CutterWay>& ways, const WayOrder& order, const WorkProgress& progress)
      : ways_(ways), order_(order), progress_(progress) {}

  std::vector<MillRun> runs() {
    constexpr std::size_t rounds = 3;
    chain();
    for (std::size_t round = 0; round < rounds; ++round) {
      const double before = rapids(chains_);
      shorten(progress_.part(0.4, 1).stage(round, rounds));
      shorten_directed();
      for (int turn = 0; turn < 4; ++turn) turn_loops();
      constexpr double worthwhile = 0.999;
      if (rapids(chains_) > worthwhile * before) break;
    }
    std::vector<MillRun> runs;
    runs.reserve(chains_.size());
    for (const Chain& chain : chains_) runs.push_back(run_of(chain));
    return runs;
  }

 private:
  const CutterWay& way(const EnteredWay& entered) const { return ways_[entered.way]; }
  DrawnPoint start(const EnteredWay& entered) const { return way(entered).points[entered.entry]; }
  DrawnPoint end(const EnteredWay& entered) const {
    const DrawnRing& points = way(entered).points;
    return way(entered).is_closed ? start(entered) : entered.entry == 0 ? points.back() : points.front();
  }
  void turn(EnteredWay& open) const {
    open.entry = open.entry == 0 ? static_cast<std::uint32_t>(way(open).points.size() - 1) : 0;
  }
  DrawnPoint start(const Chain& chain) const { return start(chain.front()); }
  DrawnPoint end(const Chain& chain) const { return end(chain.back()); }

  void chain();
  void shorten(const WorkProgress& progress);
  void shorten_directed();
  void turn_loops();
  double rapids(const std::vector<Chain>& chains) const;
  MillRun run_of(const Chain& chain) const;

  const std::vector<CutterWay>& ways_;
  const WayOrder& order_;
  const WorkProgress& progress_;
  std::vector<Chain> chains_;
};

// Always to the nearest way that is left.
void WayOrderer::chain() {
  std::vector<DrawnPoint> places;
  std::vector<EnteredWay> entered;
  std::vector<std::uint32_t> firsts;  // place of each way's first point
  for (std::uint32_t i = 0; i < ways_.size(); ++i) {
    firsts.push_back(static_cast<std::uint32_t>(places.size()));
    const auto count = static_cast<std::uint32_t>(ways_[i].points.size());
    const std::uint32_t step = ways_[i].is_closed ? 1 : ways_[i].may_be_turned ? std::max(1U, count - 1) : count;
    for (std::uint32_t k = 0; k < count; k += step) {
      places.push_back(ways_[i].points[k]);
      entered.push_back({i, k});
    }
  }
  firsts.push_back(static_cast<std::uint32_t>(places.size()));
  PlaceTree left(places);
  DrawnPoint at = order_.start;
  const WorkProgress chaining = progress_.part(0, 0.4);
  for (std::size_t done = 0; done < ways_.size(); ++done) {
    const EnteredWay next = entered[left.nearest_left(at)];
    const bool stays_down = !chains_.empty() && order_.may_link(at, start(next));
    if (!stays_down) chains_.emplace_back();
    chains_.back().push_back(next);
    at = end(next);
    for (std::uint32_t place = firsts[next.way]; place < firsts[next.way + 1]; ++place) left.forget(place);
    chaining.stage(done, ways_.size()).update(1);
  }
}

double WayOrderer::rapids(const std::vector<Chain>& chains) const {
  double length = 0;
  DrawnPoint at = order_.start;
  for (const Chain& chain : chains) {
    length += distance_nm(at, start(chain));
    at = end(chain);
  }
  return order_.end ? length + distance_nm(at, *order_.end) : length;
}

// Each chain is represented by its start.
void WayOrderer::shorten(const WorkProgress& progress) {
  std::vector<DrawnPoint> places;
  for (const Chain& chain : chains_) places.push_back(start(chain));
  constexpr std::uint64_t enough_a_place = 5'000;
  const std::uint64_t steps = std::min(order_.route_steps, enough_steps(places.size(), enough_a_place));
  std::vector<Chain> shorter;
  for (const std::uint32_t index : shorten_route(places, order_.start, order_.end, steps, progress)) {
    shorter.push_back(chains_[index]);
  }
  if (rapids(shorter) < rapids(chains_)) chains_ = std::move(shorter);
}

// A chain does not end where it begins, and may be reversed only if it is a single open path.
void WayOrderer::shorten_directed() {
  std::vector<RoutePiece> pieces;
  for (const Chain& chain : chains_)
    pieces.push_back({start(chain), end(chain), chain.size() == 1 && way(chain.front()).may_be_turned});
  std::vector<Chain> shorter;
  for (const PlacedPiece& placed : shorten_piece_order(pieces, order_.start, order_.end, order_.route_steps)) {
    Chain& chain = shorter.emplace_back(std::move(chains_[placed.piece]));
    if (placed.is_turned) turn(chain.front());
  }
  chains_ = std::move(shorter);
}

// A loop on its own begins where the way to it and on from it is shortest.
void WayOrderer::turn_loops() {
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    EnteredWay& loop = chains_[i].front();
    if (chains_[i].size() > 1 || !way(loop).is_closed) continue;
    const DrawnPoint before = i == 0 ? order_.start : end(chains_[i - 1]);
    const std::optional<DrawnPoint> after = i + 1 == chains_.size() ? order_.end : start(chains_[i + 1]);
    double best = std::numeric_limits<double>::max();
    const DrawnRing& points = way(loop).points;
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      const double length = distance_nm(before, points[k]) + (after ? distance_nm(points[k], *after) : 0);
      if (length < best) loop.entry = k;
      best = std::min(best, length);
    }
  }
}

MillRun WayOrderer::run_of(const Chain& chain) const {
  MillRun run;
  for (const EnteredWay& entered : chain) {
    const CutterWay& one = way(entered);
    DrawnRing points = one.points;
    if (one.is_closed) {
      std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(entered.entry), points.end());
      points.push_back(points.front());
    } else if (entered.entry > 0) {
      std::ranges::reverse(points);
    }
    ArcFit arcs = order_.arcs;
    if (one.is_exact) arcs.even_chord_nm = 0;
    for (const PathPoint& point : with_arcs(points, arcs)) run.push_back({point.at, point.bulge, order_.z});
  }
  return run;
}

}  // namespace

std::vector<MillRun> order_ways(const std::vector<CutterWay>& ways, const WayOrder& order,
                                const WorkProgress& progress) {
  if (ways.empty()) return {};
  return WayOrderer(ways, order, progress).runs();
}

}  // namespace passo
