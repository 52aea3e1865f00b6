// ProbeMove: a probe move as a drive runs it: the board's probe is watched from the beginning to the end of the move,
// and what is heard of it becomes places on the machine.
//
// The board tells the motors' positions at the very event of the contact; so the place is exact to the step, however
// much later the machine comes to rest.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "passo/interpreter/probe_outcome.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"
#include "passo/stepgen/step_generator.hpp"

namespace passo {

class ProbeMove {
 public:
  // The link outlives it.
  ProbeMove(Link& link, const StepOptions& steps) : link_(link), steps_(steps) {}

  // Where the outcome is written, at the beginning of a move (whether it is refused) and at its end. Outlives it.
  void tell(ProbeOutcome& outcome) { told_ = &outcome; }
  // Who wants to know at the end.
  void watch(std::function<void(const ProbeOutcome&)> watcher) { watchers_.push_back(std::move(watcher)); }

  // Also in other moves: contact() tells that the probe, which was free, was touched.
  void guard_other_moves();
  bool guards() const { return guards_; }

  // At rest, at the place that the action tells.
  void begin(const Action& action);
  bool is_running() const { return running_; }
  // What the board watches for has happened.
  bool contact() const { return link_.probe_report().happened; }
  // At rest again; where, if that is not the end of the move.
  void end(const Point& rest);

 private:
  Point contact_place(const ProbeReport& report) const;

  Link& link_;
  StepOptions steps_;
  bool guards_ = false;
  bool running_ = false;
  Point start_;
  ProbeOutcome outcome_;
  ProbeOutcome* told_ = nullptr;
  std::vector<std::function<void(const ProbeOutcome&)>> watchers_;
};

}  // namespace passo
