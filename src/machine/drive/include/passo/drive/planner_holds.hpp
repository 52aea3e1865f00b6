// PlannerHolds: why the machine is to rest, and what the planner knows of it. The planner brakes as soon as there is a
// reason that demands it, and goes on when there is none any more.
#pragma once

#include "passo/drive/holds.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class PlannerHolds {
 public:
  // The planner outlives this.
  explicit PlannerHolds(Planner& planner) : planner_(planner) {}

  const HoldReasons& reasons() const { return reasons_; }
  bool has(HoldReason reason) const { return reasons_.has(reason); }
  bool any_of(HoldReasons others) const { return reasons_.any_of(others); }

  // The planner brakes for the reason, or goes on.
  void change(HoldReason reason, bool holds);
  // The reason alone: at rest the planner is not asked.
  void set(HoldReason reason, bool holds = true) { reasons_.set(reason, holds); }
  // At rest: these reasons have done what they were for.
  void end(std::initializer_list<HoldReason> ended);

  // Feeds are multiplied by both factors. Less than a hundredth of the feed is a reason to rest.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);

 private:
  void update_planner();
  void update_feed_hold();

  Planner& planner_;
  HoldReasons reasons_;
  bool planner_holds_ = false;  // what the planner was told last
  bool planner_stops_ = false;
  double feed_override_ = 1;
  double adaptive_feed_ = 1;
};

}  // namespace passo
