#include "region_strips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "flat_vector.hpp"

namespace passo {
namespace {

constexpr Nanometres no_end{std::numeric_limits<std::int64_t>::max() / 4};

__extension__ using Wide = __int128;

// Where an edge meets a seam. The result does not depend on the edge's direction, so both strips get the same.
DrawnPoint at_seam(DrawnPoint a, DrawnPoint b, Nanometres seam) {
  if (b < a) std::swap(a, b);
  const Wide run = b.x.count - a.x.count;
  const Wide rise = static_cast<Wide>(b.y.count - a.y.count) * (seam.count - a.x.count);
  const Wide half = rise >= 0 ? run / 2 : -run / 2;
  return {seam, {a.y.count + static_cast<std::int64_t>((rise + half) / run)}};
}

// The part of a ring at one side of an X.
DrawnRing at_side(const DrawnRing& ring, Nanometres seam, bool is_above) {
  DrawnRing part;
  const auto is_in = [&](DrawnPoint point) { return is_above ? point.x >= seam : point.x <= seam; };
  const auto add = [&part](DrawnPoint point) {
    if (part.empty() || part.back() != point) part.push_back(point);
  };
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    if (is_in(ring[last]) != is_in(ring[i])) add(at_seam(ring[last], ring[i], seam));
    if (is_in(ring[i])) add(ring[i]);
  }
  while (part.size() > 1 && part.front() == part.back()) part.pop_back();
  return part;
}

// Links the pieces between seams to rings.
class SeamJoiner {
 public:
  SeamJoiner(std::set<Nanometres> seams, bool straightens) : seams_(std::move(seams)), straightens_(straightens) {}

  std::vector<DrawnRing> join(std::vector<DrawnRing> rings) {
    for (DrawnRing& ring : rings) take(std::move(ring));
    for (const auto& [seam, ends] : on_seams_) link_rest(seam, ends);
    for (std::size_t i = 0; i < pieces_.size(); ++i) starts_[pieces_[i].front()].push_back(i);
    is_used_.resize(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!is_used_[i]) follow(i);
    }
    return std::move(whole_);
  }

 private:
  bool is_on_seam(DrawnPoint a, DrawnPoint b) const { return a.x == b.x && seams_.contains(a.x); }

  // Breaks a ring at the edges on seams.
  void take(DrawnRing ring) {
    std::size_t first = ring.size();
    for (std::size_t i = 0; i < ring.size() && first == ring.size(); ++i) {
      if (is_on_seam(ring[i], ring[(i + 1) % ring.size()])) first = i;
    }
    if (first == ring.size()) return whole_.push_back(std::move(ring));
    DrawnRing piece;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const DrawnPoint a = ring[(first + k) % ring.size()];
      const DrawnPoint b = ring[(first + k + 1) % ring.size()];
      if (is_on_seam(a, b)) {
        if (piece.size() > 1) pieces_.push_back(std::move(piece));
        piece = {b};
        std::map<Nanometres, int>& ends = on_seams_[a.x];
        ++ends[a.y];
        --ends[b.y];
      } else {
        piece.push_back(b);
      }
    }
    if (piece.size() > 1) pieces_.push_back(std::move(piece));
  }

  // What does not cancel out on a seam. `ends`: how many edges begin at each Y, less how many end there.
  void link_rest(Nanometres seam, const std::map<Nanometres, int>& ends) {
    int upwards = 0;
    Nanometres from{};
    for (const auto& [y, count] : ends) {
      for (int i = 0; i < upwards; ++i) pieces_.push_back({{seam, from}, {seam, y}});
      for (int i = 0; i < -upwards; ++i) pieces_.push_back({{seam, y}, {seam, from}});
      upwards += count;
      from = y;
    }
  }

  void follow(std::size_t first) {
    DrawnRing ring;
    std::size_t piece = first;
    while (!is_used_[piece]) {
      is_used_[piece] = true;
      add(ring, pieces_[piece]);
      piece = next(pieces_[piece], first);
    }
    straighten(ring, ring.size() - 1);
    if (ring.size() > 2) whole_.push_back(std::move(ring));
  }

  // The piece whose corner with this one is the narrowest on the left: so rings that meet in a point stay apart.
  std::size_t next(const DrawnRing& piece, std::size_t first) const {
    const std::vector<std::size_t>& starts = starts_.at(piece.back());
    if (starts.size() == 1) return starts.front();
    const FlatVector back = from_to(piece.back(), piece[piece.size() - 2]);
    std::size_t best = starts.front();
    double least = 3 * std::numbers::pi;
    for (const std::size_t start : starts) {
      if (is_used_[start] && start != first) continue;
      const FlatVector on = from_to(pieces_[start][0], pieces_[start][1]);
      double turn = std::atan2(cross(on, back), dot(on, back));
      if (turn <= 0) turn += 2 * std::numbers::pi;
      if (turn < least) best = start;
      least = std::min(least, turn);
    }
    return best;
  }

  void add(DrawnRing& ring, const DrawnRing& piece) const {
    for (std::size_t i = 1; i < piece.size(); ++i) {
      ring.push_back(piece[i]);
      if (i == 1 && ring.size() > 2) straighten(ring, ring.size() - 2);
    }
  }
  void straighten(DrawnRing& ring, std::size_t index) const {
    constexpr double rounding = 1;  // nm
    if (!straightens_ || ring.size() < 3) return;
    const DrawnPoint before = ring[(index + ring.size() - 1) % ring.size()];
    const DrawnPoint after = ring[(index + 1) % ring.size()];
    const FlatVector along = from_to(before, after);
    const FlatVector off = from_to(before, ring[index]);
    const double length = std::hypot(along.x, along.y);
    const bool is_between = dot(off, along) >= 0 && dot(off, along) <= length * length;
    if (is_between && std::abs(cross(off, along)) <= rounding * length)
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(index));
  }

  std::set<Nanometres> seams_;
  bool straightens_;  // leaves out the places where an edge was cut in two
  std::vector<DrawnRing> whole_;
  std::vector<DrawnRing> pieces_;
  std::map<Nanometres, std::map<Nanometres, int>> on_seams_;
  std::map<DrawnPoint, std::vector<std::size_t>> starts_;
  std::vector<bool> is_used_;
};

}  // namespace

std::vector<RegionStrip> strips_of(const std::vector<DrawnRing>& rings, std::size_t corners, Nanometres narrowest) {
  constexpr std::size_t most_strips = 200;
  std::vector<Nanometres> places;
  for (const DrawnRing& ring : rings) {
    for (const DrawnPoint& point : ring) places.push_back(point.x);
  }
  std::vector<RegionStrip> strips = {{{-no_end.count}, no_end}};
  const std::size_t count = std::min(places.size() / corners, most_strips);
  if (count < 2) return strips;
  std::ranges::sort(places);
  Nanometres before = places.front();
  for (std::size_t i = 1; i < count; ++i) {
    const Nanometres place = places[i * places.size() / count] + Nanometres{1};  // most edges on a seam are cuts
    if (place < before + narrowest || place + narrowest > places.back()) continue;
    strips.back().high = place;
    strips.push_back({place, no_end});
    before = place;
  }
  return strips;
}

StripCutter::StripCutter(std::vector<DrawnRing> rings) : rings_(std::move(rings)) {
  for (const DrawnRing& ring : rings_) boxes_.push_back(box_of(ring));
}

std::vector<DrawnRing> StripCutter::within(const RegionStrip& strip) const {
  std::vector<DrawnRing> whole;
  std::vector<DrawnRing> parts;
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    const DrawnBox& box = boxes_[i];
    if (box.most.x < strip.low || box.least.x > strip.high) continue;
    if (box.least.x > strip.low && box.most.x < strip.high) {
      whole.push_back(rings_[i]);
      continue;
    }
    DrawnRing part = box.least.x < strip.low ? at_side(rings_[i], strip.low, true) : rings_[i];
    if (box.most.x > strip.high && !part.empty()) part = at_side(part, strip.high, false);
    if (part.size() > 2) parts.push_back(std::move(part));
  }
  if (!parts.empty())
    std::ranges::move(SeamJoiner({strip.low, strip.high}, false).join(std::move(parts)), std::back_inserter(whole));
  return whole;
}

std::vector<DrawnRing> joined_at_seams(std::vector<DrawnRing> rings, const std::vector<RegionStrip>& strips) {
  std::set<Nanometres> seams;
  for (std::size_t i = 1; i < strips.size(); ++i) seams.insert(strips[i].low);
  return SeamJoiner(std::move(seams), true).join(std::move(rings));
}

}  // namespace passo
