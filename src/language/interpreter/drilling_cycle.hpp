// DrillingCycle: the holes of one block with a drilling, tapping or boring cycle (G73, G74, G81 … G89), as operations.
//
// The moves are those of RS274/NGC (NIST 6556, 3.5.16), in LinuxCNC's order. Depth and height are measured along the
// axis perpendicular to the active plane. Lengths are in millimetres.
#pragma once

#include <cstdint>
#include <optional>

#include "code_table.hpp"
#include "cycle.hpp"
#include "program_state.hpp"

namespace passo {

// The distance from hole to hole in polar coordinates: a change of the radius and of the angle about the origin (@ and
// ^ in incremental mode).
struct PolarWay {
  double radius = 0;
  double angle = 0;  // radians
};

struct DrillingPlan {
  CodeNumber code = 0;
  Axis axis = Axis::z;  // direction of the holes
  Point start;          // tool position before the cycle
  Point hole;           // the first hole; its height is ignored
  std::int32_t holes = 1;
  std::optional<Point> way = {};       // from hole to hole; empty: all holes are at the same position
  std::optional<PolarWay> polar = {};  // used instead of `way`
  double initial_height = 0;           // tool height before the first of consecutive cycles
  bool returns_to_initial = false;     // G98: between holes, the tool retracts to the initial height, not only to
                                       // `retract`
  double retract = 0;                  // R: the height at which the feed begins
  double bottom = 0;
  double top = 0;                        // height of the top of a back bore
  Point aside = {};                      // G87: lateral offset of the tool, in the plane
  double dwell = 0;                      // P, seconds
  double peck = 0;                       // Q
  std::optional<double> clearance = {};  // D: retract distance of a peck; empty: LinuxCNC's 0.254 mm
  SpindleDirection spindle = SpindleDirection::off;
  bool feed_override = true;  // whether the override was on: it is switched on again after a tap
  bool speed_override = true;
  bool retracts_by_hand = false;              // G88: true: the operator retracts the tool, not the cycle
  PathMode path_mode = PathMode::continuous;  // the mode after the cycle
  PathTolerance tolerance = {};
};

class DrillingCycle final : public Cycle {
 public:
  DrillingCycle(const DrillingPlan& plan, const OperationSource& source);

  // Returns whether the cycle was aborted, because the angle is undefined at the origin (DrillingPlan::polar).
  bool stuck() const { return stuck_; }

 private:
  bool step() override;
  void begin();
  bool go_to_hole();
  bool find_hole(Point& hole);
  bool peck();
  void finish_hole();
  void tap();
  void bore_back();
  void end();
  void traverse_to(double height);
  void feed_to(double height);
  void traverse_by(const Point& way) { traverse(position_ + way); }

  DrillingPlan plan_;
  double height_ = 0;   // height at which the tool moves to the next hole
  double clear_ = 0;    // height to which the tool retracts from a hole
  double reached_ = 0;  // height reached by the pecks so far
  std::int32_t holes_left_;
  bool begun_ = false;
  bool in_hole_ = false;
  bool stuck_ = false;
};

// The properties of each cycle. DrillingCodes checks the words with these functions.
constexpr bool pecks(CodeNumber number) {
  return number == code(73) || number == code(83);
}
constexpr bool taps(CodeNumber number) {
  return number == code(74) || number == code(84);
}
constexpr bool dwells(CodeNumber number) {
  return number == code(82) || number == code(86) || number == code(88) || number == code(89);
}
constexpr bool stops_spindle(CodeNumber number) {
  return number == code(86) || number == code(87) || number == code(88);
}

}  // namespace passo
