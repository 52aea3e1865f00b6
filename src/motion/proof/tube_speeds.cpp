#include "tube_speeds.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

constexpr double nowhere = -1e18;
constexpr std::array<std::size_t, 3> spans = {1, 4, 16};  // of the legs whose normals are asked
constexpr double parallel = 1e-6;
constexpr double as_good = 0.98;

// The greatest speed with which a way can be left that is no longer than this and takes no less than this time.
double speed_on(double way, double time, double strength) {
  const double free = std::sqrt(2 * strength * way);
  return time * strength >= free ? free : way / time + strength * time / 2;
}

}  // namespace

TubeSpeeds::TubeSpeeds(const std::vector<ProvenAxis>& axes, const std::vector<SpeedLimit>& limits) : axes_(axes) {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const ProvenAxis& axis = axes_[i];
    const SpeedLimit limit = axis.start_stop > MmPerSecond(0) ? SpeedLimit(axis) : limits[i];
    ramps_.emplace_back(axis, limit);
    tops_.push_back(axis.velocity.value() > 0 ? axis.velocity.value() : TubePath::fastest);
    strengths_.push_back(std::max(limit.at(0), 0.0));
  }
}

// What the second round knows of the first is how long the ways between stations take.
void TubeSpeeds::limit(const std::vector<Station>& path, Rests rests) {
  leaving_.assign(path.size(), {});
  arriving_.assign(path.size(), {});
  most_.assign(path.size(), {});
  for (auto& most : most_) {
    for (std::size_t d = 0; d < 2 * axes_.size(); ++d) most[d] = tops_[d / 2];
  }
  knows_speeds_ = false;
  forget_times(path.size());
  const Walk forwards{path, false};
  const Walk backwards{path, true};
  for (int round = 0; round < 2; ++round) {
    std::vector<Speeds> leaving(path.size());
    std::vector<Speeds> arriving(path.size());
    pass(forwards, rests.first, leaving);
    pass(backwards, rests.last, arriving);
    leaving_ = std::move(leaving);
    arriving_ = std::move(arriving);
    knows_speeds_ = true;
    forget_times(path.size());
    if (round == 0) limit_planes(forwards);
  }
}

void TubeSpeeds::forget_times(std::size_t stations) {
  Times unknown;
  unknown.fill(-1);
  times_.assign(stations, unknown);
}

void TubeSpeeds::pass(const Walk& walk, bool rests, std::vector<Speeds>& speeds) {
  for (std::size_t direction = 0; direction < 2 * axes_.size(); ++direction) {
    const std::size_t axis = direction / 2;
    const std::size_t turned = walk.backwards ? direction ^ 1U : direction;
    double start_place = rests ? sign_of(direction) * walk.station(0).place[axis] : nowhere;
    for (std::size_t i = 0; i < walk.path.size(); ++i) {
      Speed& speed = speeds[walk.number(i)][turned];
      if (!ramps_[axis].limits()) {
        speed = {.most = tops_[axis], .pace = 1 / tops_[axis]};
      } else if (i == 0 && rests) {
        speed = {.most = 0, .pace = 0};
      } else {
        speed = speed_at(walk, i, direction, start_place);
      }
    }
  }
}

// `start_place` is that of the station before, and becomes that of this one.
TubeSpeeds::Speed TubeSpeeds::speed_at(const Walk& walk, std::size_t i, std::size_t direction, double& start_place) {
  const std::size_t axis = direction / 2;
  const double sign = sign_of(direction);
  const Station& here = walk.station(i);
  const double latest = sign * here.place[axis] + here.slack;
  double most = most_[walk.number(i)][walk.backwards ? direction ^ 1U : direction];
  double lowest = latest;
  double known = nowhere;
  double feed = 0;
  std::uint16_t group = i > 0 ? walk.leg(i).group : 0;
  for (std::size_t j = i; j > 0 && j + stations_seen > i; --j) {
    const Station& leg = walk.leg(j);
    lowest = std::min(lowest, (sign > 0 ? leg.low[axis] : -leg.high[axis]) - leg.around);
    if (j == i) known = std::min(start_place, lowest);
    if (j < i && lowest <= known) break;
    feed = std::max(feed, leg.feed);
    if (leg.group != group) group = 0;
    if (!is_seen(i - j + 1)) continue;
    const double time = least_time(walk, j - 1, i, feed, group);
    if (ramps_[axis].comes_from_rest(latest - lowest, time)) {
      known = std::max(known, lowest);
      break;
    }
    if (time > 0) most = std::min(most, speed_on(latest - lowest, time, strengths_[axis]));
  }
  if (i == 0) known = start_place;
  // A speed has a start place, too.
  start_place = std::max(known, latest - 2 * here.slack - ramps_[axis].way_from_rest(most));
  const double by_place =
      start_place > nowhere / 2 ? std::sqrt(ramps_[axis].square_after(0, std::max(latest - start_place, 0.0))) : most;
  // Both limits hold. The one by the place says more of what the place costs.
  if (by_place * as_good < most) return {.most = by_place, .pace = by_place > 0 ? 1 / by_place : 0};
  return {.most = most, .pace = 1 / tops_[axis]};
}

// At the speed of the slower end.
double TubeSpeeds::axis_time_at_most(const std::vector<Station>& path, std::size_t from, std::size_t to,
                                     std::size_t direction) const {
  const std::size_t axis = direction / 2;
  const double way =
      sign_of(direction) * (path[to].place[axis] - path[from].place[axis]) - path[from].slack - path[to].slack;
  if (!(way > 0)) return 0;
  return way / std::min({leaving_[from][direction].most, arriving_[to][direction].most, tops_[axis]});
}

double TubeSpeeds::axis_time(const std::vector<Station>& path, std::size_t from, std::size_t to, std::size_t direction,
                             Rests rests) const {
  const std::size_t axis = direction / 2;
  const double way =
      sign_of(direction) * (path[to].place[axis] - path[from].place[axis]) - path[from].slack - path[to].slack;
  if (!(way > 0)) return 0;
  if (!ramps_[axis].limits()) return way / tops_[axis];
  const double start = rests.first ? 0 : leaving_[from][direction].most;
  const double end = rests.last ? 0 : arriving_[to][direction].most;
  return ramps_[axis].least_time({.start = squared(start), .end = squared(end), .top = squared(tops_[axis])}, way);
}

// Between two stations of a walk. `feed` is the greatest on the legs between them. The time is the same for all
// directions and both walks, so it is kept.
double TubeSpeeds::least_time(const Walk& walk, std::size_t from, std::size_t to, double feed, std::uint16_t group) {
  const std::size_t first = std::min(walk.number(from), walk.number(to));
  const std::size_t last = std::max(walk.number(from), walk.number(to));
  double& time = times_[last][number_seen(last - first)];
  if (time < 0) time = time_between(walk.path, first, last, feed, group);
  return time;
}

double TubeSpeeds::time_between(const std::vector<Station>& path, std::size_t first, std::size_t last, double feed,
                                std::uint16_t group) const {
  const Station& start = path[first];
  const Station& end = path[last];
  double time = 0;
  double squares = 0;
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    const double way = end.place[axis] - start.place[axis];
    if ((group >> axis & 1U) != 0) squares += way * way;
    const double least = std::abs(way) - start.slack - end.slack;
    if (!(least > 0)) continue;
    time = std::max(
        time, knows_speeds_ ? axis_time(path, first, last, 2 * axis + (way < 0 ? 1 : 0), {}) : least / tops_[axis]);
  }
  return std::max(time, (std::sqrt(squares) - start.slack - end.slack) / feed);
}

void TubeSpeeds::limit_planes(const Walk& walk) {
  const std::size_t last = walk.path.size() - 1;
  const Walk backwards{walk.path, true};
  for (std::size_t i = 1; i < last; ++i) {
    for (Plane plane{1, 0}; plane.first < axes_.size(); ++plane.first) {
      for (plane.second = 0; plane.second < plane.first; ++plane.second) {
        if (!ramps_[plane.first].limits() || !ramps_[plane.second].limits()) continue;
        limits_.clear();
        for (const std::size_t span : spans) {
          if (span <= i) add_limits(walk, i, i - span, plane);
          if (i + span <= last) add_limits(backwards, last - i, last - i - span, plane);
        }
        if (!limits_.empty()) combine(i, plane);
      }
    }
  }
}

// Limits the speed at right angles to the straight line from station `until` to station i, by what was between them.
void TubeSpeeds::add_limits(const Walk& walk, std::size_t i, std::size_t until, const Plane& plane) {
  const Station& here = walk.station(i);
  const Station& there = walk.station(until);
  const double x = here.place[plane.first] - there.place[plane.first];
  const double y = here.place[plane.second] - there.place[plane.second];
  const double length = std::hypot(x, y);
  if (!(length > 2 * (here.slack + there.slack))) return;
  const double normal_x = -y / length;
  const double normal_y = x / length;
  const auto height = [&](const Station& station) {
    return normal_x * (station.place[plane.first] - here.place[plane.first]) +
           normal_y * (station.place[plane.second] - here.place[plane.second]);
  };
  double highest = 0;
  double lowest = 0;
  double beside = 0;
  double feed = 0;
  std::uint16_t group = walk.leg(i).group;
  for (std::size_t j = i; j > until; --j) {
    const Station& leg = walk.leg(j);
    const double level = height(walk.station(j - 1));
    highest = std::max(highest, level);
    lowest = std::min(lowest, level);
    beside = std::max(beside, leg.around + leg.bulge);
    feed = std::max(feed, leg.feed);
    if (leg.group != group) group = 0;
  }
  const double time = least_time(walk, until, i, feed, group);
  if (!(time > 0)) return;
  const double strength = std::abs(normal_x) * strengths_[plane.first] + std::abs(normal_y) * strengths_[plane.second];
  const double turned = walk.backwards ? -1 : 1;
  const auto add = [&](double sign, double way) {
    limits_.push_back({.x = sign * turned * normal_x,
                       .y = sign * turned * normal_y,
                       .most = speed_on(way + here.slack + beside, time, strength)});
  };
  add(1, -lowest);
  add(-1, highest);
}

// A speed along an axis is a sum of two others with positive weights, and at most the same sum of their limits.
void TubeSpeeds::combine(std::size_t station, const Plane& plane) {
  const auto own_limit = [&](std::size_t direction) {
    return std::min(leaving_[station][direction].most, arriving_[station][direction].most);
  };
  for (const std::size_t up : {2 * plane.first, 2 * plane.second}) {
    const double x = up == 2 * plane.first ? 1 : 0;
    limits_.push_back({.x = x, .y = 1 - x, .most = own_limit(up)});
    limits_.push_back({.x = -x, .y = x - 1, .most = own_limit(up + 1)});
  }
  for (std::size_t a = 0; a < limits_.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const Limit& one = limits_[a];
      const Limit& other = limits_[b];
      const double turn = one.x * other.y - one.y * other.x;
      if (std::abs(turn) < parallel) continue;
      // Of the sum with the weights `share` and `rest` along x: share = other.y / turn, rest = −one.y / turn. Along −x
      // both have the other sign, and along y x takes the place of y.
      const auto meet = [&](double of_one, double of_other, std::size_t up) {
        const double share = of_other / turn;
        const double rest = of_one / turn;
        const double sum = share * one.most + rest * other.most;
        if (share >= 0 && rest >= 0) most_[station][up] = std::min(most_[station][up], sum);
        if (share <= 0 && rest <= 0) most_[station][up + 1] = std::min(most_[station][up + 1], -sum);
      };
      if (one.y * other.y <= 0) meet(-one.y, other.y, 2 * plane.first);
      if (one.x * other.x <= 0) meet(one.x, -other.x, 2 * plane.second);
    }
  }
}

}  // namespace passo::proof
