// TubePath: the programmed path as stations and legs, for a bound that holds for every path in the tolerance tube
// around it.
//
// A station is a point of the programmed path. A motion within the tolerance passes near each station, in the order of
// the stations. Between two stations, on a leg, it is near the part of the path between them: within the range of each
// axis, widened by the tolerance. So the stations may be chosen freely, and arbitrarily short moves may lie between
// them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact_curve.hpp"

#include "passo/path/segment.hpp"
#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

// One number per checked axis.
using AxisNumbers = std::array<double, max_motors>;

// A station and the leg that ends there. The leg of the first station is unused.
struct Station {
  AxisNumbers place{};
  double slack = 0;   // maximum distance of the motion from the station: the tolerance, and 0 at a stop
  AxisNumbers low{};  // the range of the leg's points
  AxisNumbers high{};
  double around = 0;  // maximum distance of the motion from the leg
  double bulge = 0;   // maximum distance of the leg's points from the straight line between its ends
  double feed = 0;    // the largest feed on the leg; `fastest` if there is none
  std::uint16_t group =
      0;  // the axes to which the feed applies, one bit each; 0: segments differ, so that the feed is unknown
};

// A bound at a station considers previous stations up to this distance: each of the nearest ones, and every fourth of
// the others. Any choice is a bound, and what lies in between adds little.
inline constexpr std::size_t stations_seen = 32;
constexpr bool is_seen(std::size_t back) {
  return back <= 4 || (back <= stations_seen && back % 4 == 0);
}
// Their numbers, from 0 on.
constexpr std::size_t number_seen(std::size_t back) {
  return back <= 4 ? back - 1 : 2 + back / 4;
}
inline constexpr std::size_t most_seen = number_seen(stations_seen) + 1;

class TubePath {
 public:
  static constexpr double fastest = 1e6;  // mm/s, a feed that is no limit

  explicit TubePath(const std::vector<ProvenAxis>& axes) : axes_(axes) {}

  void add(const Segment& segment);
  // Call if the path stops at its current end.
  void rest();

  const std::vector<Station>& stations() const { return stations_; }
  // Begins again with the last station.
  void restart();

 private:
  struct Piece {
    AxisNumbers from{};
    AxisNumbers to{};
    AxisNumbers low{};
    AxisNumbers high{};
    double bulge = 0;
    double way = 0;
  };

  void add_piece(const ExactCurve& curve, double from, double to);
  Piece piece_of(const ExactCurve& curve, double from, double to) const;
  double turn_of(const ExactCurve& curve, double from, double to) const;
  void widen(const Piece& piece);
  void end_leg();
  std::uint16_t group_of(const ExactCurve& curve) const;
  void allow_for_turns(const Segment& segment, const ExactCurve& curve);
  void find_feed(const Segment& segment, const ExactCurve& curve);

  const std::vector<ProvenAxis>& axes_;
  std::vector<Station> stations_;
  Station leg_;            // the one that is growing
  double way_ = 0;         // length of the growing leg; 0: it has not begun
  double bulge_ = 0;       // the largest of its pieces
  double last_slack_ = 0;  // the tolerance of the previous segment
  double slack_ = 0;       // the tolerance around the current segment
  double turn_slack_ = 0;  // the largest tolerance of A, B and C since one of them turned; 0: none has turned
  double feed_ = 0;        // of the current segment
  std::uint16_t group_ = 0;
};

}  // namespace passo::proof
