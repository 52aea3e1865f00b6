// ProbeMove: a probe move as a drive runs it. The board watches its probe from the beginning to the end of the move.
// ProbeMove converts the board's reports into machine positions.
//
// The board reports the motors' positions at the event of the contact. So the contact position is exact to the step, no
// matter how much later the machine stops.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "passo/interpreter/machine_results.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class ProbeMove {
 public:
  // `link` and `answers` must outlive the ProbeMove. The outcome is written into `answers` at the beginning of a move
  // (whether the move is rejected) and at the end.
  ProbeMove(Link& link, StoredResults& answers, const Kinematics& kinematics)
      : link_(link), answers_(answers), kinematics_(kinematics) {}

  // Adds an observer that receives the outcome at the end of each probe move.
  void watch(std::function<void(const ProbeOutcome&)> watcher) { watchers_.push_back(std::move(watcher)); }

  // Also watches the probe in other moves: contact() then reports that the open probe was triggered.
  void guard_other_moves() { guards_ = true; }
  bool guards() const { return guards_; }
  // Two queries to the board, at standstill: the first between probe moves, the second before a probe move. The board
  // has to answer before the drive continues.
  void ask_to_watch_others() { link_.watch_probe(guards_ ? ProbeUntil::touched : ProbeUntil::off); }
  void ask_to_watch(const Action& action);

  // Call when the board watches. The machine is stopped at the position given by the action. `downs`: the axes whose
  // backlash is taken up there for motion in the negative direction.
  void begin(const Action& action, AxisSet downs);
  bool is_running() const { return running_; }
  // Returns true if the watched event has happened.
  bool contact() const { return link_.probe_report().happened; }
  // The same, once for each watch.
  [[nodiscard]] bool is_new_contact() { return contact() && !std::exchange(contact_seen_, true); }
  // Sets the end of the motion in the move, if it is not the move's end.
  void record_end(const Point& end) { end_ = end; }
  // After the move, while stopped: recall() reads the captured position, unless the move was rejected. When the board
  // has answered, find() computes the outcome. `planned_end`: the programmed end of the move.
  void recall();
  void find(const Point& planned_end);
  // Passes the outcome to `answers` and to the observers.
  void end();

 private:
  Point contact_place(const ProbeReport& report, const Point& rest) const;

  Link& link_;
  StoredResults& answers_;
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
