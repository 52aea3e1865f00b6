// TubeSpeeds: the maximum speed of each axis where a motion in the tube passes the stations.
//
// An axis that passes a station with the speed v must have started from rest at a point at least v²/2A before it. If
// the motion cannot have been beyond some point within the time needed to reach v, the starting point is not beyond it
// either. So a corner limits the axis that was idle before it. The same holds backwards in time, and limits the axis
// that will be idle. In each plane of two axes the same bound is computed for directions perpendicular to the legs, so
// that it includes corners between diagonal legs.
#pragma once

#include <array>
#include <vector>

#include "axis_ramp.hpp"
#include "tube_path.hpp"

namespace passo::proof {

// Each axis has two directions: 2 i is positive on axis i, 2 i + 1 is negative.
inline constexpr std::size_t most_directions = 2 * std::size_t{max_motors};
constexpr double sign_of(std::size_t direction) {
  return direction % 2 == 0 ? 1.0 : -1.0;
}

class TubeSpeeds {
 public:
  // `limits`: those of an axis with a start-stop velocity do not count.
  TubeSpeeds(const std::vector<ProvenAxis>& axes, const std::vector<SpeedLimit>& limits);

  struct Rests {  // at the first and the last of two stations
    bool first = false;
    bool last = false;
  };
  // `rests`: whether the path stops at its ends.
  void limit(const std::vector<Station>& path, Rests rests);

  struct Speed {
    double most = 0;  // mm/s
    double pace = 0;  // s/mm: the time lost, or saved, per mm by which the motion passes the station later, or sooner
  };
  // leaving(): the speed with which the axis leaves the station, limited by the motion before it. arriving(): the speed
  // with which it arrives, limited by the motion after it.
  const Speed& leaving(std::size_t station, std::size_t direction) const { return leaving_[station][direction]; }
  const Speed& arriving(std::size_t station, std::size_t direction) const { return arriving_[station][direction]; }

  double top(std::size_t axis) const { return tops_[axis]; }
  double strength(std::size_t axis) const { return strengths_[axis]; }
  const AxisRamp& ramp(std::size_t axis) const { return ramps_[axis]; }
  // Returns a lower bound of the time between two stations in which an axis moves in this direction. 0 if it need not
  // move. `rests`: where this axis is known to be stopped.
  double axis_time(const std::vector<Station>& path, std::size_t from, std::size_t to, std::size_t direction,
                   Rests rests) const;
  // Returns an upper bound of that time, which costs less. Infinite: the axis may be stopped at an end.
  double axis_time_at_most(const std::vector<Station>& path, std::size_t from, std::size_t to,
                           std::size_t direction) const;

 private:
  using Speeds = std::array<Speed, most_directions>;
  // The path forwards in time, or backwards: then the last station is number 0, and directions are reversed.
  struct Walk {
    const std::vector<Station>& path;
    bool backwards;
    std::size_t number(std::size_t i) const { return backwards ? path.size() - 1 - i : i; }
    const Station& station(std::size_t i) const { return path[number(i)]; }
    const Station& leg(std::size_t i) const { return path[backwards ? path.size() - i : i]; }  // before station i
  };
  struct Plane {  // plane of two axes
    std::size_t first;
    std::size_t second;
  };
  struct Limit {  // limit of a velocity in the plane: x first + y second <= most
    double x, y, most;
  };

  void pass(const Walk& walk, bool rests, std::vector<Speeds>& speeds);
  using Times = std::array<double, most_seen>;
  void forget_times(std::size_t stations);
  Speed speed_at(const Walk& walk, std::size_t i, std::size_t direction, double& start_place);
  double least_time(const Walk& walk, std::size_t from, std::size_t to, double feed, std::uint16_t group);
  double time_between(const std::vector<Station>& path, std::size_t first, std::size_t last, double feed,
                      std::uint16_t group) const;
  void limit_planes(const Walk& walk);
  void add_limits(const Walk& walk, std::size_t i, std::size_t until, const Plane& plane);
  void combine(std::size_t station, const Plane& plane);

  const std::vector<ProvenAxis>& axes_;
  std::vector<AxisRamp> ramps_;
  std::vector<double> tops_;
  std::vector<double> strengths_;  // at standstill; 0: no limit
  std::vector<Speeds> leaving_;
  std::vector<Speeds> arriving_;
  std::vector<std::array<double, most_directions>> most_;  // by planes
  std::vector<Limit> limits_;
  std::vector<Times> times_;   // of least_time(), by the last station; below 0: unknown
  bool knows_speeds_ = false;  // speeds from a previous round are available
};

}  // namespace passo::proof
