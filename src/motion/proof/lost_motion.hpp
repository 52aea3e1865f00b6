// LostMotion: how far the tool is behind the plan because the backlash of an axis was not taken up.
//
// It computes the place of the tool from the place of the motor, and from nothing else that the plan says about
// backlash. A motor at m pushes its axis up to m, or pulls it down to m + backlash; in between, the axis does not move:
//
//   place = max(place, m)                going up
//   place = min(place, m + backlash)     going down
//
// The difference between this place and the planned one must stay within a step, for the reversals that are too small
// to be taken up. A path begins with all backlash taken up for motion in the positive direction.
//
// In a move that takes up backlash while the path continues (Segment::lead), the tool may be off the planned path along
// one axis. From the plan, only the mark of such a move is used, with its axis: the position along this axis is
// computed as above, and PathDeviation judges the path of the tool. Along the other axes the tool is as far behind as
// in every other move.
#pragma once

#include <span>
#include <vector>

#include "exact_curve.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class LostMotion {
 public:
  // Writes its findings into `proof`, whose axes and limits are already set.
  LostMotion(const ProofOptions& options, MotionProof& proof);

  void watch(const PlannedMove& move, const ExactCurve& curve, Seconds now);
  // The positions of the tool in that move, if it takes up backlash in motion; otherwise none.
  std::span<const Point> way_of_tool() const { return way_; }

 private:
  struct Play {
    std::size_t number = 0;  // of the axis
    Axis axis = Axis::x;
    double backlash = 0;
    double place = 0;  // of the tool
  };
  static double motor_of(const Play& play, const PlannedMove& move, double at);
  void follow(Play& play, const PlannedMove& move, double at, Seconds now);

  MotionProof& proof_;
  std::vector<Play> plays_;
  std::vector<Point> way_;
  bool begun_ = false;
};

}  // namespace passo::proof
