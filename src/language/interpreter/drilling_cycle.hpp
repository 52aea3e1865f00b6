// DrillingCycle: the holes of one block with a drilling, tapping or boring cycle (G73, G74, G81 … G89), as operations.
//
// The moves are those of RS274/NGC (NIST 6556, 3.5.16) in the order in which LinuxCNC makes them. Depth and height are
// measured along the axis through the active plane. Lengths are in millimetres.
#pragma once

#include <cstdint>
#include <optional>

#include "code_table.hpp"
#include "cycle.hpp"
#include "program_state.hpp"

namespace passo {

// The way from hole to hole: a change of the distance from the origin and of the angle about it (@ and ^ in incremental
// distances).
struct PolarWay {
  double radius = 0;
  double angle = 0;  // radians
};

struct DrillingPlan {
  CodeNumber code = 0;
  Axis axis = Axis::z;  // the direction of the holes
  Point start;          // the tool's position before the cycle
  Point hole;           // the first hole; its height does not count
  std::int32_t holes = 1;
  std::optional<Point> way = {};       // from hole to hole; empty: all holes are at one place
  std::optional<PolarWay> polar = {};  // used instead of `way`
  double initial_height = 0;           // the tool's height before the first of several cycles
  bool returns_to_initial = false;     // G98: the tool goes to this height between holes, not only to `retract`
  double retract = 0;                  // R: the height where the feed begins
  double bottom = 0;
  double top = 0;                        // the top of a back bore
  Point aside = {};                      // G87: how far the tool goes aside, in the plane
  double dwell = 0;                      // P, seconds
  double peck = 0;                       // Q
  std::optional<double> clearance = {};  // D: how far a peck goes back; empty: LinuxCNC's 0.254 mm
  SpindleDirection spindle = SpindleDirection::off;
  bool feed_override = true;  // whether the override was on: it is switched on again after a tap
  bool speed_override = true;
  bool retracts_by_hand = false;              // G88: true: the operator retracts the tool, and the cycle does not
  PathMode path_mode = PathMode::continuous;  // the mode after the cycle
  PathTolerance tolerance = {};
};

class DrillingCycle final : public Cycle {
 public:
  DrillingCycle(const DrillingPlan& plan, const OperationSource& source);

  // True: the cycle broke off, because at the origin there is no angle to go on from (DrillingPlan::polar).
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
  double height_ = 0;   // the height at which the tool goes to the next hole
  double clear_ = 0;    // the height to which the tool leaves a hole
  double reached_ = 0;  // the height that the pecks have reached so far
  std::int32_t holes_left_;
  bool begun_ = false;
  bool in_hole_ = false;
  bool stuck_ = false;
};

// What each cycle does. DrillingCodes checks the words with these functions.
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
