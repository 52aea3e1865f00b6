// TubeBound: a time that no motion on any path in the tube can beat within velocity, acceleration and feed.
//
// The bound of TimeBound holds for the path that the smoother chose. This one holds for all paths that stay within the
// tolerance of the programmed path. The programmed path is cut into stations (TubePath). Several bounds hold for the
// time between two stations: that of each axis for its own way, from and to the speeds that it can have there
// (TubeSpeeds), and that of the feed. What is added up is the best choice of stations and of one bound between each two
// of them, found station by station.
//
// Each bound is that of a motion that passes its two stations where it helps most. Two bounds that meet at a station
// want different places there. A place that is d farther on in a direction costs the one pace · d at least and spares
// the other as much, so the two together lose the tolerance times the difference of their paces, as vectors, and not
// both sizes.
//
// What is neglected, so that the bound can be too small: two axes limit the motion together only at stations; jerk.
// Memory: a window of stations. Where a stretch is longer than the window, any speed is allowed at the window's end.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tube_path.hpp"
#include "tube_speeds.hpp"

namespace passo::proof {

class TubeBound {
 public:
  explicit TubeBound(const ProofOptions& options);

  void watch(const PathItem& item);
  // Call once, after the last item.
  Seconds finish();

 private:
  // What bounds the time up to a station: a direction of an axis, or the straight line of a leg.
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
  std::vector<Times> from_;   // of each station: the bound up to it, where one of each kind follows
  std::vector<Times> turns_;  // the same, where an axis turns back into that direction
  std::vector<Pace> lines_;   // of each station: the pace along the leg that ends there
};

}  // namespace passo::proof
