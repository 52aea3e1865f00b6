// PlannerHolds: the hold reasons, and their state in the planner. The planner decelerates while at least one reason
// requires a stop, and continues otherwise.
#pragma once

#include "passo/drive/holds.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class PlannerHolds {
 public:
  // The planner must outlive this object.
  explicit PlannerHolds(Planner& planner) : planner_(planner) {}

  const HoldReasons& reasons() const { return reasons_; }
  bool has(HoldReason reason) const { return reasons_.has(reason); }
  bool any_of(HoldReasons others) const { return reasons_.any_of(others); }

  // Sets or clears the reason, and updates the planner.
  void change(HoldReason reason, bool holds);
  // Sets or clears the reason without updating the planner, at standstill.
  void set(HoldReason reason, bool holds = true) { reasons_.set(reason, holds); }
  // Clears these reasons at standstill, because their purpose is fulfilled.
  void end(std::initializer_list<HoldReason> ended);

  // Multiplies feeds by both factors. Less than a hundredth of the feed is a reason to hold.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);

 private:
  void update_planner();
  void update_feed_hold();

  Planner& planner_;
  HoldReasons reasons_;
  bool planner_holds_ = false;  // the last state given to the planner
  bool planner_stops_ = false;
  double feed_override_ = 1;
  double adaptive_feed_ = 1;
};

}  // namespace passo
