// ProbeMove: a probe move as a drive runs it. The board watches its probe from the beginning to the end of the move.
// ProbeMove turns what the board tells into places on the machine.
//
// The board tells the motors' positions at the very event of the contact. So the place is exact to the step, however
// much later the machine comes to rest.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "passo/interpreter/machine_answers.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class ProbeMove {
 public:
  // `link` and `answers` outlive the ProbeMove. The outcome is written into `answers` at the beginning of a move
  // (whether the move is refused) and at the end.
  ProbeMove(Link& link, AnswerBook& answers, const Kinematics& kinematics)
      : link_(link), answers_(answers), kinematics_(kinematics) {}

  // Adds a watcher that gets the outcome at the end of each probe move.
  void watch(std::function<void(const ProbeOutcome&)> watcher) { watchers_.push_back(std::move(watcher)); }

  // Watches the probe in other moves too: contact() then tells that the probe, which was free, was touched.
  void guard_other_moves() { guards_ = true; }
  bool guards() const { return guards_; }
  // Two questions to the board, at rest: the first between probe moves, the second before a probe move. The board has
  // to answer before the next step.
  void ask_to_watch_others() { link_.watch_probe(guards_ ? ProbeUntil::touched : ProbeUntil::off); }
  void ask_to_watch(const Action& action);

  // The board watches now. The machine rests at the place that the action names. `downs`: the axes whose backlash is
  // taken up for motion down there.
  void begin(const Action& action, AxisSet downs);
  bool is_running() const { return running_; }
  // True: what the board watches for has happened.
  bool contact() const { return link_.probe_report().happened; }
  // The same, once for each watch.
  [[nodiscard]] bool is_new_contact() { return contact() && !std::exchange(contact_seen_, true); }
  // Motion in the move ends there, if not at the move's end.
  void record_end(const Point& end) { end_ = end; }
  // After the move, at rest: recall() asks what the board has kept, unless the move was refused. When the board has
  // answered, find() works out the outcome. `planned_end`: of the move.
  void recall();
  void find(const Point& planned_end);
  // Tells the outcome to `answers` and to the watchers.
  void end();

 private:
  Point contact_place(const ProbeReport& report, const Point& rest) const;

  Link& link_;
  AnswerBook& answers_;
  Kinematics kinematics_;
  bool guards_ = false;
  bool running_ = false;
  bool contact_seen_ = false;
  std::optional<Point> end_;
  Point start_;
  AxisSet downs_;
  ProbeOutcome outcome_;
  std::vector<std::function<void(const ProbeOutcome&)>> watchers_;
};

}  // namespace passo
