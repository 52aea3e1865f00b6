// PathDeviation: the maximum distance between programmed and planned path, in both directions.
//
// Two points move along the two paths from start to end, and never back. The result is the smallest distance that they
// can keep, a Fréchet distance (Alt and Godau 1995), in units of the tolerances at each point: millimetres are divided
// by the path tolerance, degrees of A, B and C by their own tolerance, and the two are added as the root of the sum of
// their squares. Nearest points alone are not enough: a path that turns, or has loops smaller than its tolerance, is
// near itself.
//
// The planned path is processed in small pieces. For each piece of the programmed path, the smallest distance is stored
// with which the two points can be there now. A piece is dropped if it needs twice as much as the best one and more
// than twice the tolerance. Actions are in both paths: there the two points meet again.
//
// A point's tolerance is the larger of those at both junctions of its segment. Where that is 0 the paths must coincide,
// except for rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "exact_curve.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class PathDeviation {
 public:
  explicit PathDeviation(MotionProof& proof) : proof_(proof) {}

  void programmed(const PathItem& item);
  void planned(const PlannedMove& move, const ExactCurve& curve, Seconds time);
  // The same for a tool that moved along a polyline.
  void went(std::span<const Point> places, Seconds time);
  // Returns the greatest speed that is programmed where the two points can be now, or could be before the last move. 0:
  // nothing was programmed.
  double programmed_speed() const { return std::max(speed_before_, speed_); }
  // Processes an action of the planned motion, or its end: everything programmed before it must have been executed.
  void rest(Seconds time);
  // Ends the measurement: any remaining programmed path was never executed.
  void finish(Seconds time);

 private:
  struct Programmed {
    ExactCurve curve;
    double tolerance;
    double degree;  // millimetres for which a degree counts: the tolerance divided by that of A, B and C
    std::uint32_t line;
    double speed;  // mm/s
    int pieces;    // the number of pieces kept
  };
  // The worst point so far on the best match of the two paths.
  struct Worst {
    double multiple = INFINITY;
    Finding finding;

    void raise(double away, const Programmed& of, Seconds time);
  };
  struct Piece {
    Programmed* of;
    double from;
    double to;
    Point begin;
    std::uint64_t stretch;  // number of the section between two actions
    Worst now;              // while the point on the planned path is somewhere on this piece
  };
  // A piece of the planned path.
  struct Stride {
    const ExactCurve& curve;
    double from;
    double to;
    Seconds time;
  };

  bool is_in_stretch(std::size_t piece) const;
  void begin(const Point& place, Seconds time);
  void step(const Stride& stride);
  Worst passed(const Worst& before, const Piece& piece, const Stride& stride) const;
  static void stay(Piece& piece, const Point& place, Seconds time);
  void give_up();
  void drop_front();
  void end_stretch(Seconds time);
  void note_speed();
  double distance_from_last(const Point& place, const Programmed& of) const;

  MotionProof& proof_;
  std::deque<Programmed> chain_;
  std::deque<Piece> pieces_;
  std::size_t reached_ = 0;  // the number of pieces reached, from the first one on
  double most_ = 0;          // the largest multiple that is kept
  std::uint64_t programmed_stretch_ = 0;
  std::uint64_t planned_stretch_ = 0;
  double last_tolerance_ = 0;
  double last_turn_tolerance_ = 0;
  std::optional<Point> place_;  // the last point of the planned path
  double speed_before_ = 0;
  double speed_ = 0;
};

}  // namespace passo::proof
