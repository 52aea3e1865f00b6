// PathDeviation: how far programmed and planned path are from each other, in both directions.
//
// Both lead the same way in the same order. The planned path is walked in small pieces; for each of its points the
// nearest place of the programmed path is looked for a little before and behind the place of the point before, and each
// point of the programmed path (its corners, and some between them) keeps its distance from the nearest piece that
// passes by. Actions are in both paths: there the two are together again.
//
// A place's tolerance is the larger one of the junctions at both ends of its segment; where that is 0 the path must be
// met, to rounding.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "exact_curve.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class PathDeviation {
 public:
  explicit PathDeviation(MotionProof& proof) : proof_(proof) {}

  void programmed(const PathItem& item);
  void planned(const PlannedMove& move, Seconds time);
  // An action of the planned motion, or its end: what was programmed before it has been played.
  void rest(Seconds time);
  // The end: whatever is still left of the programmed path was never played.
  void finish(Seconds time);

 private:
  struct Programmed {
    ExactCurve curve;
    double begin;  // way from the program's start, as that of all places here
    double tolerance;
    std::uint64_t stretch;  // of the path between two actions
    std::uint32_t line;

    double end() const { return begin + curve.length(); }
  };
  struct Sample {
    double at;
    Point place;
    double tolerance;
    double distance;  // from the planned path, so far
    std::uint64_t stretch;
    std::uint32_t line;
  };
  struct Match {
    double at = 0;
    double distance = 0;
    bool onwards = false;  // within the tolerance, and not back
    const Programmed* segment = nullptr;
  };

  Match match(const Point& point, double from, double to, double expected) const;
  Match match_ahead(const Point& point, double step, double expected) const;
  void walk(const ExactCurve& curve, double from, double to, Seconds time);
  void approach(const ExactCurve& curve, double from, double to, double before, double step);
  void forget(double before, Seconds time);
  void raise(double value, double tolerance, std::uint32_t line, Seconds time);

  MotionProof& proof_;
  std::deque<Programmed> chain_;
  std::deque<Sample> samples_;
  double length_ = 0;  // of all that is programmed
  std::uint64_t programmed_stretch_ = 0;
  std::uint64_t planned_stretch_ = 0;
  double last_tolerance_ = 0;
  double at_ = 0;               // where the last planned point is on the programmed path
  double farthest_ = 0;         // of those of the stretch
  std::optional<Point> place_;  // that point
};

}  // namespace passo::proof
