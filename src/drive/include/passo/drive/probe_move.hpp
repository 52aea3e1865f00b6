// ProbeMove: a probe move as a drive runs it: the board's probe is watched from the beginning to the end of the move,
// and what is heard of it becomes places on the machine.
//
// The board tells the motors' positions at the very event of the contact; so the place is exact to the step, however
// much later the machine comes to rest.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "passo/interpreter/machine_answers.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"
#include "passo/stepgen/step_generator.hpp"

namespace passo {

class ProbeMove {
 public:
  // Both outlive it. The outcome is written at the beginning of a move (whether it is refused) and at its end.
  ProbeMove(Link& link, AnswerBook& answers, const StepOptions& steps)
      : link_(link), answers_(answers), steps_(steps) {}

  // Who wants to know at the end.
  void watch(std::function<void(const ProbeOutcome&)> watcher) { watchers_.push_back(std::move(watcher)); }

  // Also in other moves: contact() tells that the probe, which was free, was touched.
  void guard_other_moves() { guards_ = true; }
  bool guards() const { return guards_; }
  // At rest, between probe moves; and before one. The board has to answer before the next step.
  void ask_to_watch_others() { link_.watch_probe(guards_ ? ProbeUntil::touched : ProbeUntil::off); }
  void ask_to_watch(const Action& action);

  // The board watches. At rest, at the place that the action tells.
  void begin(const Action& action);
  bool is_running() const { return running_; }
  // What the board watches for has happened.
  bool contact() const { return link_.probe_report().happened; }
  // At rest again: asks what the board has kept, if something moved; and what that means, when the board has answered.
  // `rest`: where the machine stands.
  void recall();
  void find(const Point& rest);
  // Tells the outcome.
  void end();

 private:
  Point contact_place(const ProbeReport& report) const;

  Link& link_;
  AnswerBook& answers_;
  StepOptions steps_;
  bool guards_ = false;
  bool running_ = false;
  Point start_;
  ProbeOutcome outcome_;
  std::vector<std::function<void(const ProbeOutcome&)>> watchers_;
};

}  // namespace passo
