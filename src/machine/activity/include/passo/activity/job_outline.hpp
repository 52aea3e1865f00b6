// JobOutline: the outline of a program seen from above: the extents and the convex hull of its feed moves, and its
// highest position. It is collected from the path items of a check, for framing the job before the cut.
//
// Lengths are mm in machine coordinates. The extents are exact. The hull is exact for lines; on arcs it lies inside by
// at most 0.04 % of the radius. Memory is bounded: a hull with many corners keeps the outermost points of 512
// directions, which leave out at most 0.002 % of its radius.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "passo/path/segment.hpp"

namespace passo {

class JobOutline {
 public:
  using Spot = std::array<double, 2>;  // X and Y

  void add(const PathItem& item);

  // Returns whether the program has no feed moves.
  bool empty() const { return low_[0] > high_[0]; }
  const Spot& low() const { return low_; }
  const Spot& high() const { return high_; }
  // Returns the corners of the hull, counterclockwise, from the lowest X on. At least one.
  std::vector<Spot> hull() const;
  // Returns the highest Z of the feed moves, and of the ends of the rapids before them. The rapids after the last feed
  // move do not count: they may park the tool.
  double top() const { return top_; }
  // Returns the work zero at the last feed move.
  const Point& work_zero() const { return work_zero_; }

 private:
  void add_spot(const Point& place);
  void shrink();

  Spot low_{1e300, 1e300};
  Spot high_{-1e300, -1e300};
  double top_ = -1e300;
  double rapid_top_ = -1e300;  // of the rapids since the last feed move
  Point work_zero_;
  std::vector<Spot> spots_;  // among them the corners of the hull
};

}  // namespace passo
