#include "passo/drive/planner_holds.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

constexpr double no_feed = 0.01;

}  // namespace

void PlannerHolds::change(HoldReason reason, bool holds) {
  if (reasons_.has(reason) == holds) return;
  reasons_.set(reason, holds);
  update_planner();
}

void PlannerHolds::end(std::initializer_list<HoldReason> ended) {
  for (const HoldReason reason : ended) reasons_.remove(reason);
  update_planner();
}

// The planner takes back both of its holds at once, so the one that remains is told again.
void PlannerHolds::update_planner() {
  const bool holds = reasons_.any_of(heeded_holds);
  const bool stops = reasons_.any_of(sure_holds);
  if ((planner_holds_ && !holds) || (planner_stops_ && !stops)) {
    planner_.resume();
    planner_holds_ = planner_stops_ = false;
  }
  if (holds && !std::exchange(planner_holds_, holds)) planner_.hold();
  if (stops && !std::exchange(planner_stops_, stops)) planner_.stop();
}

void PlannerHolds::set_feed_override(double factor) {
  feed_override_ = factor;
  planner_.set_feed_override(factor);
  update_feed_hold();
}

void PlannerHolds::set_adaptive_feed(double factor) {
  adaptive_feed_ = factor;
  planner_.set_adaptive_feed(factor);
  update_feed_hold();
}

void PlannerHolds::update_feed_hold() {
  const double feed = std::min({feed_override_, adaptive_feed_, feed_override_ * adaptive_feed_});
  reasons_.set(HoldReason::zero_feed, feed < no_feed);
}

}  // namespace passo
