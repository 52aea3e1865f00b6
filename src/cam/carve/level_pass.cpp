// ReliefPass on ways of lines and arcs: how it gets to them, down to their depth, and along them.
#include <algorithm>
#include <cmath>

#include "relief_passes.hpp"

namespace passo {
namespace {

CarvedCut backwards(const CarvedCut& cut) {
  CarvedCut other = cut;
  std::swap(other.from, other.to);
  other.counterclockwise = !cut.counterclockwise;
  return other;
}

double level_length(const CarvedCut& cut) {
  CarvedCut level = cut;
  level.to.z = level.from.z;
  return length_of(level);
}

}  // namespace

FlatPlace ReliefPass::flat(const CarvedPlace& place) const {
  return {static_cast<double>(place.x) / carved_units - lattice_.x0,
          static_cast<double>(place.y) / carved_units - lattice_.y0};
}

// By rapids to above a place where no stock stands from `free_above` upwards.
void ReliefPass::approach(const CarvedPlace& place, double free_above) {
  constexpr double above = 0.5;  // mm, of the stock, where the feed begins
  const std::int64_t clearance = carved_height(options_.clearance.value());
  writer_.rapid_up_down(clearance);
  writer_.rapid_to(place.x, place.y);
  const double free = stock_ != nullptr ? std::max(free_above, stock_->rapid_height(flat(place))) : free_above;
  writer_.rapid_up_down(std::min(carved_height(free + above), clearance));
  is_at_work_ = true;
}

void ReliefPass::emit(CarvedCut cut, std::int64_t z) {
  cut.to.z = std::max(cut.to.z, z);
  if (cut.kind == CarvedCut::Kind::line) {
    writer_.cut_to(cut.to);
  } else {
    writer_.arc_to(cut);
  }
}

// Round and round a closed way, or there and back at the begin of an open one, deeper all the time. A way that is too
// short for the ramp's angle is gone along so many times at most, and the ramp is steeper. Returns the cut of the way
// that comes next.
std::size_t ReliefPass::ramp_down(const LevelPath& path, double from, double to) {
  constexpr double most_turns = 40;
  const double drop = from - to;
  const double wanted = drop / std::tan(options_.ramp.value);
  std::vector<CarvedCut> ramp;
  std::size_t next = 0;
  double way = 0;
  if (path.is_closed) {
    double all = 0;
    for (const CarvedCut& cut : path.cuts) all += level_length(cut);
    const double most = std::min(wanted, all * most_turns);
    while (way < most) {
      way += level_length(path.cuts[next]);
      ramp.push_back(path.cuts[next]);
      next = (next + 1) % path.cuts.size();
    }
  } else {
    std::vector<CarvedCut> there;
    while (there.size() < path.cuts.size() && way < wanted / 2) {
      there.push_back(path.cuts[there.size()]);
      const double length = level_length(there.back());
      const double rest = wanted / 2 - way;
      if (there.back().kind == CarvedCut::Kind::line && length > rest) {
        there.back().to = place_on(there.back(), rest / length);
        way = wanted / 2;
      } else {
        way += length;
      }
    }
    const double turns = std::clamp(std::ceil(wanted / 2 / std::max(way, 1e-6)), 1.0, most_turns);
    for (double turn = 0; turn < turns; ++turn) {
      ramp.insert(ramp.end(), there.begin(), there.end());
      for (std::size_t i = there.size(); i-- > 0;) ramp.push_back(backwards(there[i]));
    }
    way *= 2 * turns;
  }
  double gone = 0;
  for (const CarvedCut& cut : ramp) {
    gone += level_length(cut);
    emit(cut, carved_height(way > 0 ? from - drop * std::min(1.0, gone / way) : to));
  }
  return next;
}

void ReliefPass::cut_way(const LevelPath& path, const TipSurface& surface, const WayEntry& entry) {
  if (path.cuts.empty()) return;
  const CarvedPlace start = path.cuts.front().from;
  double lowest = static_cast<double>(start.z) / carved_units;
  for (const CarvedCut& cut : path.cuts) {
    if (!entry.is_row) lowest = std::min(lowest, static_cast<double>(cut.to.z) / carved_units);
  }
  const double free = entry.is_row          ? stock_->free_height_inside(flat(start))
                      : entry.cuts_with_rim ? stock_->free_height_inside(path.cuts)
                                            : stock_->free_height(path.cuts);
  constexpr double nothing = 1e-4;  // mm
  if (entry.is_for_stock && free <= lowest + nothing) return;
  std::size_t next = 0;
  const auto at = static_cast<double>(writer_.place().z) / carved_units;
  const double apart = distance_between(flat(writer_.place()), flat(start));
  const bool is_near = is_at_work_ && apart <= entry.near;
  const auto is_free_at = [&](double height) {
    return surface.highest(flat(writer_.place()), flat(start)) <= height + 2 * LevelLines::slack;
  };
  const double over = std::max({at, free, static_cast<double>(start.z) / carved_units});
  const double start_z = static_cast<double>(start.z) / carved_units;
  const double begin = std::max(free, start_z);
  if (is_near && entry.sideways && at <= lowest + nothing && is_free_at(at)) {
    writer_.cut_to({start.x, start.y, writer_.place().z});
    writer_.cut_to(start);
  } else if (is_near && over - at <= 1 && is_free_at(over)) {
    // Above the stock of the new way, sideways, and down along the way.
    const std::int64_t z = carved_height(over);
    writer_.cut_to({writer_.place().x, writer_.place().y, z});
    writer_.cut_to({start.x, start.y, z});
    if (options_.ramps && over > lowest + nothing) next = ramp_down(path, over, lowest);
  } else {
    approach(start, begin);
    writer_.cut_to({start.x, start.y, carved_height(begin)});
    if (options_.ramps && begin > lowest + nothing) next = ramp_down(path, begin, lowest);
  }
  if (!path.is_closed || next == 0) writer_.cut_to(start);
  for (std::size_t i = 0; i < path.cuts.size(); ++i) {
    const CarvedCut& cut = path.cuts[(next + i) % path.cuts.size()];
    emit(cut, cut.to.z);
  }
  if (record_ != nullptr) record_->add(path.cuts, lattice_, surface);
}

void ReliefPass::follow(const LevelPath& path, const TipSurface& surface) {
  if (path.cuts.empty()) return;
  writer_.cut_to(path.cuts.front().from);
  for (const CarvedCut& cut : path.cuts) emit(cut, cut.to.z);
  if (record_ != nullptr) record_->add(path.cuts, lattice_, surface);
}

}  // namespace passo
