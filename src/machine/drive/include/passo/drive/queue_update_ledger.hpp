// QueueUpdateLedger: the items sent to a board in queue updates (refills), and those that the board has executed. It
// notifies the observers of executed motion and items, and of possible stop points.
//
// All times are times of motion: the ledger's clock stops while nothing moves.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/played_items.hpp"
#include "passo/drive/played_motion.hpp"
#include "passo/drive/stop_ramp_planner.hpp"

namespace passo {

class QueueUpdateLedger {
 public:
  struct Refill {
    ItemNumber first = 0;
    ItemNumber last_of_motion = 0;
    ItemNumber last = 0;  // the last item of the stop ramp; without one, of the motion
    StopRamp tail = {};   // no later queue update stops before its start
  };

  // The link must outlive the ledger. Everything before `done` is already executed.
  QueueUpdateLedger(const Link& link, Hertz tick_rate, const PathPosition& done)
      : link_(link), tick_rate_(tick_rate), done_(done) {}

  // Adds an observer of each item that the board has reported as executed, including executed stop ramps.
  void watch_executed(std::function<void(const LinkItem&)> watcher) { played_.watch(std::move(watcher)); }
  // Adds an observer of the motion that the board has executed, including executed stop ramps. Motion that was planned
  // again is reported as executed.
  void watch_motion(std::function<void(const MotionItem&)> watcher) { motion_played_.watch(std::move(watcher)); }
  // Adds an observer that is called before each queue update with the stop points possible from then on.
  void watch_rests(std::function<void(const BoardStop&)> watcher) { rest_watcher_ = std::move(watcher); }

  // The total time of the planned motion, and of its executed part. Motion repeated after an early stop replaces the
  // unexecuted motion.
  Seconds given_time() const { return given_in_all_; }
  Seconds executed_time() const;
  // How often a stop ramp was executed to its end and the path was continued from there.
  int recoveries() const { return counts_.recoveries; }
  // How often the speed was limited because of a long stop ramp.
  int slowdowns() const { return counts_.slowdowns; }
  // How many of the sent items belonged to stop ramps.
  std::uint64_t tail_items() const { return counts_.tail_items; }
  std::uint64_t refills() const { return counts_.refills; }
  // The longest motion in the board's queue, without the stop ramp, while a queue update waited for its answer. After a
  // contact the board has at most twice as much: the answer that the probe is open is no older than that.
  Seconds longest_ahead() const { return longest_ahead_; }

  // Records motion emitted by the planner.
  void record_given(const MotionItem& motion, Seconds time);
  const PlayedMotion& motion_played() const { return motion_played_; }
  // Reports a possible stop point. Call it before a queue update or outputs are sent: from then on, the board may stop
  // there.
  void report_rest(ItemNumber executed, const PathPosition& place) const;
  void record_motion(const LinkItem& item, ItemNumber number, Seconds time);
  void record_refill(Refill refill);  // call it after its motion
  // Call when a queue update waits for an answer.
  void on_question();
  // Reports outputs that were sent separately and are switched.
  void show(const BoardOutputs& outputs) const { played_.show(outputs); }

  // Processes the number of the last executed item, as reported by the board.
  void on_executed(ItemNumber executed);
  // Returns the queue update that the board is executing (no later one has begun), or null if there is none.
  const Refill* under_way() const { return under_way_.empty() ? nullptr : &under_way_.front(); }
  // Call when the board has executed the last queue update. `on_tail`: including its stop ramp. Returns the stop point.
  StopOnPath end_refill(bool on_tail);
  void on_recovery() { ++counts_.recoveries; }
  void set_slowdowns(int slowdowns) { counts_.slowdowns = slowdowns; }
  // Call when the board is stopped and all sent items are executed.
  void record_rest();
  // Call when the board is stopped. Drops all items sent after the stop point, which will never be executed.
  void forget_unexecuted();

  // The time of motion sent and not executed, counted in whole items; surely_ahead() excludes the current item, because
  // the board may be at its end.
  Seconds ahead() const { return ahead_; }
  Seconds surely_ahead() const { return motion_.empty() ? ahead_ : ahead_ - motion_.front().time; }
  // The same, as last reported by the board together with the spindle's angle.
  const std::optional<Seconds>& told_ahead() const { return told_ahead_; }
  void forget_told() { told_ahead_.reset(); }
  // The same for all planned motion, at `time`, the time of the reported event.
  Seconds ahead_of(const Turned& turned, Seconds time);
  // The start time of the current motion, by the board's clock.
  const std::optional<Seconds>& began() const { return began_; }
  // The time of the item's first `of_events` events.
  Seconds time_of(const LinkItem& item, int of_events = most_events) const;

 private:
  struct Motion {
    ItemNumber number = 0;
    Seconds time{0};
    Seconds end{0};  // time since the last stop
    LinkItem item = {};
  };
  struct Counts {
    int recoveries = 0;
    int slowdowns = 0;
    std::uint64_t tail_items = 0;
    std::uint64_t refills = 0;
  };

  const Link& link_;
  Hertz tick_rate_;
  PlayedItems played_;
  PlayedMotion motion_played_;
  std::function<void(const BoardStop&)> rest_watcher_;
  std::deque<Motion> motion_;     // sent and not executed
  std::deque<Refill> under_way_;  // the board executes the first
  PathPosition done_;             // the board is known to have executed everything up to here
  Seconds ahead_{0};
  Seconds given_time_{0};  // all planned motion since the last stop
  Seconds sent_time_{0};   // the part of given_time_ that was sent
  Seconds given_in_all_{0};
  Seconds passed_{0};       // all motion executed before the last stop
  Seconds item_begins_{0};  // when the board began the current item, as far as is known
  std::optional<Seconds> told_ahead_;
  std::optional<Seconds> began_;
  Seconds longest_ahead_{0};
  Counts counts_;
};

}  // namespace passo
