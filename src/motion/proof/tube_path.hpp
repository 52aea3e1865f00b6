// TubePath: the programmed path as stations and legs, for a bound that holds for every path in the tube around it.
//
// A station is a place of the programmed path. A motion within the tolerance is near each station at some time, in the
// order of the stations. Between two stations, on a leg, it is near the part of the path between them: within the range
// of each axis, widened by the tolerance. So the stations may be chosen freely, and what is between them may be any
// dust.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "exact_curve.hpp"

#include "passo/path/segment.hpp"
#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

// One number for each proven axis.
using AxisNumbers = std::array<double, max_motors>;

// A station and the leg that ends there. Of the first station the leg has no meaning.
struct Station {
  AxisNumbers place{};
  double slack = 0;   // how far from it the motion may pass: the tolerance, and 0 where the path rests
  AxisNumbers low{};  // the range of the leg's places
  AxisNumbers high{};
  double around = 0;  // how far the motion may be beside the leg
  double bulge = 0;   // how far the leg's places are from the straight line between its ends
  double feed = 0;    // the greatest feed on the leg; fastest if there is none
  std::uint16_t group =
      0;  // the axes that the feed counts, a bit each; 0: segments differ, so that the feed is unknown
};

// A bound at a station looks this many stations back.
inline constexpr std::size_t stations_seen = 32;

class TubePath {
 public:
  static constexpr double fastest = 1e6;  // mm/s, a feed that does not limit

  explicit TubePath(const std::vector<ProvenAxis>& axes) : axes_(axes) {}

  void add(const Segment& segment);
  // The path rests at its present end.
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

  const std::vector<ProvenAxis>& axes_;
  std::vector<Station> stations_;
  Station leg_;            // the one that is growing
  double way_ = 0;         // of the growing leg; 0: it has not begun
  double bulge_ = 0;       // the largest of its pieces
  double last_slack_ = 0;  // the tolerance of the segment before
  double slack_ = 0;       // the tolerance around the present segment
  double feed_ = 0;        // of the present segment
  std::uint16_t group_ = 0;
};

}  // namespace passo::proof
