#include "tube_bound.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

constexpr std::size_t most_stations = 4096;  // stations

double size_of(const AxisNumbers& row) {
  double sum = 0;
  for (const double part : row) sum += part * part;
  return std::sqrt(sum);
}

double size_of_difference(const AxisNumbers& a, const AxisNumbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// What is known of motion that speeds up from rest does not hold of an axis that jumps to a speed. Such an axis counts
// as if no acceleration limited it. So the bound stays below the time of every motion.
std::vector<ProvenAxis> axes_without_jumps(std::vector<ProvenAxis> axes) {
  for (ProvenAxis& axis : axes) {
    if (!(axis.start_stop > MmPerSecond(0))) continue;
    axis.acceleration = MmPerSecond2(0);
    axis.acceleration_at = {};
  }
  return axes;
}

}  // namespace

TubeBound::TubeBound(const ProofOptions& options, const std::vector<SpeedLimit>& limits)
    : axes_(axes_without_jumps(options.axes)), path_(axes_), speeds_(axes_, limits) {}

void TubeBound::watch(const PathItem& item) {
  if (const auto* action = std::get_if<Action>(&item)) {
    rest();
    time_ += action->dwell.value();
    return;
  }
  const auto& segment = std::get<Segment>(item);
  path_.add(segment);
  if (segment.mode == PathMode::exact_stop) {
    rest();
  } else if (path_.stations().size() > most_stations) {
    settle(false);
  }
}

Seconds TubeBound::finish() {
  rest();
  return Seconds(time_);
}

void TubeBound::rest() {
  path_.rest();
  settle(true);
}

void TubeBound::settle(bool rests) {
  if (path_.stations().size() > 1) time_ += least_time();
  began_at_rest_ = rests;
  path_.restart();
}

// At each station: what is known of the time up to it, if the last bound was of this kind or of that; and what this is
// worth to a bound that begins there.
double TubeBound::least_time() {
  const std::vector<Station>& path = path_.stations();
  speeds_.limit(path, {.first = began_at_rest_, .last = path.back().slack == 0});
  lines_.assign(path.size(), {});
  for (std::size_t k = 1; k < path.size(); ++k) lines_[k] = line_pace(k);
  from_.assign(path.size(), {});
  turns_.assign(path.size(), {});
  for (Times& turns : turns_) turns.fill(unused);
  double best = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const Times until = times_until(k);
    for (const double time : until) best = std::max(best, time);
    if (k + 1 == path.size()) break;
    go_on_from(k, until, best);
    for (std::size_t direction = 0; direction < 2 * axes_.size(); ++direction) {
      if (turns_back(k, direction)) turns_[k][direction ^ 1U] = time_until(k, direction, true);
    }
  }
  return best;
}

TubeBound::Times TubeBound::times_until(std::size_t station) const {
  Times until;
  until.fill(unused);
  for (std::size_t direction = 0; direction < 2 * axes_.size(); ++direction) {
    until[direction] = time_until(station, direction, false);
  }
  until[line_kind] = from_[station - 1][line_kind] + line_time(station);
  return until;
}

// The last bound is one of the axis in this direction. `rests`: whether the axis rests at the station.
double TubeBound::time_until(std::size_t station, std::size_t direction, bool rests) const {
  const std::vector<Station>& path = path_.stations();
  double until = unused;
  for (std::size_t k = station > stations_seen ? station - stations_seen : 0; k < station; ++k) {
    if (!is_seen(station - k)) continue;
    const bool turns = turns_[k][direction] != unused;
    if (!rests && !turns && from_[k][direction] + speeds_.axis_time_at_most(path, k, station, direction) <= until) {
      continue;
    }
    const double time = speeds_.axis_time(path, k, station, direction, {.first = false, .last = rests});
    if (!(time > 0)) continue;
    until = std::max(until, from_[k][direction] + time);
    if (!turns) continue;
    const double from_rest = speeds_.axis_time(path, k, station, direction, {.first = true, .last = rests});
    until = std::max(until, turns_[k][direction] + from_rest);
  }
  return until;
}

// The axis counts as resting at the station, before and after. Arriving with a speed v spares at most the time in which
// the axis comes from v to rest; and just this time it takes until it turns back.
bool TubeBound::turns_back(std::size_t station, std::size_t direction) const {
  const std::vector<Station>& path = path_.stations();
  const std::size_t axis = direction / 2;
  const double here = path[station].place[axis];
  return sign_of(direction) * (here - path[station - 1].place[axis]) > 0 &&
         sign_of(direction) * (path[station + 1].place[axis] - here) < 0;
}

void TubeBound::go_on_from(std::size_t station, const Times& until, double best) {
  Times& from = from_[station];
  from.fill(best);
  const double slack = path_.stations()[station].slack;
  std::array<Pace, most_kinds> leaving;
  std::array<double, most_kinds> sizes{};
  const auto is_used = [&](std::size_t kind) { return kind < 2 * axes_.size() || kind == line_kind; };
  for (std::size_t kind = 0; kind < most_kinds; ++kind) {
    if (!is_used(kind)) continue;
    leaving[kind] = pace_of(kind, station, false);
    sizes[kind] = size_of(leaving[kind]);
  }
  for (std::size_t last = 0; last < most_kinds; ++last) {
    if (until[last] == unused) continue;
    const Pace arriving = pace_of(last, station, true);
    const double size = size_of(arriving);
    for (std::size_t next = 0; next < most_kinds; ++next) {
      // The shared part is at most twice the smaller of both.
      if (!is_used(next) || until[last] + 2 * slack * std::min(size, sizes[next]) <= from[next]) continue;
      const double shared = size + sizes[next] - size_of_difference(arriving, leaving[next]);
      from[next] = std::max(from[next], until[last] + slack * shared);
    }
  }
}

TubeBound::Pace TubeBound::pace_of(std::size_t kind, std::size_t station, bool arrives) const {
  if (kind == line_kind) return lines_[arrives ? station : station + 1];
  Pace pace{};
  if (kind >= 2 * axes_.size()) return pace;
  const TubeSpeeds::Speed& speed = arrives ? speeds_.arriving(station, kind) : speeds_.leaving(station, kind);
  pace[kind / 2] = sign_of(kind) * speed.pace;
  return pace;
}

// That of the feed, or of the velocity of an axis, whichever takes longer for the leg that ends at the station.
TubeBound::Pace TubeBound::line_pace(std::size_t station) const {
  const Station& end = path_.stations()[station];
  const Station& start = path_.stations()[station - 1];
  Pace by_axis{};
  Pace by_feed{};
  double longest = 0;
  double length = 0;
  double crossing = 0;  // the way times the greatest speed along it
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double way = end.place[i] - start.place[i];
    if (std::abs(way) / speeds_.top(i) > longest) {
      longest = std::abs(way) / speeds_.top(i);
      by_axis = {};
      by_axis[i] = std::copysign(1 / speeds_.top(i), way);
    }
    if ((end.group >> i & 1U) == 0) continue;
    by_feed[i] = way;
    length += way * way;
    crossing += std::abs(way) * speeds_.top(i);
  }
  length = std::sqrt(length);
  const double top = length > 0 ? std::min(end.feed, crossing / length) : 0;
  if (!(length > longest * top)) return by_axis;
  for (double& part : by_feed) part /= length * top;
  return by_feed;
}

// The motion speeds up and brakes along the leg, too.
double TubeBound::line_time(std::size_t station) const {
  const std::vector<Station>& path = path_.stations();
  const Pace& pace = lines_[station];
  const double size = size_of(pace);
  const double slack = path[station - 1].slack + path[station].slack;
  double way = 0;
  double strength = 0;
  double entry = 0;
  double exit = 0;
  bool limited = true;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (pace[i] == 0) continue;
    const double part = std::abs(pace[i]) / size;
    const std::size_t direction = 2 * i + (pace[i] < 0 ? 1 : 0);
    way += pace[i] / size * (path[station].place[i] - path[station - 1].place[i]);
    limited = limited && speeds_.ramp(i).limits();
    strength += part * speeds_.strength(i);
    entry += part * speeds_.leaving(station - 1, direction).most;
    exit += part * speeds_.arriving(station, direction).most;
  }
  way -= slack;
  if (!(way > 0) || !limited) return way * size;
  if (!(strength > 0)) return way * size;
  return AxisRamp::least_time_by(strength, {.start = entry * entry, .end = exit * exit, .top = 1 / (size * size)}, way);
}

}  // namespace passo::proof
