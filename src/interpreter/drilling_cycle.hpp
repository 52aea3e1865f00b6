// DrillingCycle: the holes of one block with a drilling, tapping or boring cycle (G73, G74, G81 … G89), as operations.
//
// The moves are those of RS274/NGC (NIST 6556, 3.5.16) in the order in which LinuxCNC makes them. "Depth" and "height"
// are along the axis through the active plane. Millimetres.
#pragma once

#include <cstdint>
#include <optional>

#include "code_table.hpp"
#include "cycle.hpp"
#include "program_state.hpp"

namespace passo {

// From hole to hole by a distance from the origin and an angle about it (@ and ^ in incremental distances).
struct PolarWay {
  double radius = 0;
  double angle = 0;  // radians
};

struct DrillingPlan {
  CodeNumber code = 0;
  Axis axis = Axis::z;  // the direction of the holes
  Point start;          // where the tool is
  Point hole;           // the first hole; its height does not count
  std::int32_t holes = 1;
  std::optional<Point> way = {};       // from hole to hole; empty: all holes are at one place
  std::optional<PolarWay> polar = {};  // used instead of `way`
  double initial_height = 0;           // the tool's height when the first cycle began
  bool returns_to_initial = false;     // G98: between holes, not only to `retract`
  double retract = 0;                  // R: where the feed begins
  double bottom = 0;
  double top = 0;    // of a back bore
  Point aside = {};  // G87: how far the tool goes aside, in the plane
  double dwell = 0;  // P, seconds
  double peck = 0;   // Q
  SpindleDirection spindle = SpindleDirection::off;
  bool feed_override = true;  // whether the override is on, and is on again after a tap
  bool speed_override = true;
  bool retracts_by_hand = false;              // G88: an operator takes the tool out
  PathMode path_mode = PathMode::continuous;  // after the cycle
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
  double height_ = 0;   // to the next hole
  double clear_ = 0;    // out of a hole
  double reached_ = 0;  // by the pecks so far
  std::int32_t holes_left_;
  bool begun_ = false;
  bool in_hole_ = false;
  bool stuck_ = false;
};

// What each cycle does. The codes check their words with this.
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
