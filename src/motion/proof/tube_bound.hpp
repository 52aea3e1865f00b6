// TubeBound: a lower bound for the time of any motion on any path in the tolerance tube within velocity, acceleration
// and feed limits.
//
// The bound of TimeBound holds for the path that the smoother chose. This one holds for all paths within the tolerance
// of the programmed path. The programmed path is divided into stations (TubePath). Several bounds hold for the time
// between two stations: that of each axis for its own distance, with its maximum speeds there (TubeSpeeds), and that of
// the feed. The result is the best sum over a choice of stations and of one bound between each two of them, computed
// station by station.
//
// Each bound belongs to a motion that passes its two stations at the most favourable points. Two bounds that meet at a
// station may need different points there. A point that is farther by d in a direction costs the first motion at least
// pace · d and saves the second one the same, so the sum loses the tolerance times the difference of their paces, as
// vectors, and not both magnitudes.
//
// The bound can be too small, because it considers two axes that limit the motion together only at stations, and
// ignores jerk. Memory: a window of stations. If a section is longer than the window, any speed is allowed at the
// window's end.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tube_path.hpp"
#include "tube_speeds.hpp"

namespace passo::proof {

class TubeBound {
 public:
  TubeBound(const ProofOptions& options, const std::vector<SpeedLimit>& limits);

  void watch(const PathItem& item);
  // Call once, after the last item.
  Seconds finish();

 private:
  // The source of the bound up to a station: a direction of an axis, or the straight line of a leg.
  static constexpr std::size_t line_kind = most_directions;
  static constexpr std::size_t most_kinds = most_directions + 1;
  static constexpr double unused = -1e18;
  using Times = std::array<double, most_kinds>;
  using Pace = AxisNumbers;  // s/mm

  void rest();
  void settle(bool rests);
  double least_time();
  Times times_until(std::size_t station) const;
  double time_until(std::size_t station, std::size_t direction, bool rests) const;
  bool turns_back(std::size_t station, std::size_t direction) const;
  void go_on_from(std::size_t station, const Times& until, double best);
  double line_time(std::size_t station) const;
  Pace line_pace(std::size_t station) const;
  Pace pace_of(std::size_t kind, std::size_t station, bool arrives) const;
  const std::vector<ProvenAxis> axes_;
  TubePath path_;
  TubeSpeeds speeds_;
  bool began_at_rest_ = true;
  double time_ = 0;
  std::vector<Times> from_;   // for each station: the bound up to it, if one of each kind follows
  std::vector<Times> turns_;  // the same, if an axis reverses into that direction
  std::vector<Pace> lines_;   // for each station: the pace along the leg that ends there
};

}  // namespace passo::proof
