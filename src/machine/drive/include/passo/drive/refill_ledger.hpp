// RefillLedger: what was sent to a board in refills, and what the board has executed of it. Watchers of the executed
// motion and items, and of the places where the board may come to rest, are told from here.
//
// All times are of motion alone: the ledger's clock stands while nothing moves.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/played_items.hpp"
#include "passo/drive/played_motion.hpp"
#include "passo/drive/tail_maker.hpp"

namespace passo {

class RefillLedger {
 public:
  struct Refill {
    ItemNumber first = 0;
    ItemNumber last_of_motion = 0;
    ItemNumber last = 0;    // the tail's last item; without a tail, the motion's
    BrakingTail tail = {};  // no later refill rests before the place where it begins
  };

  // The link outlives the ledger. Nothing before `done` is to be executed.
  RefillLedger(const Link& link, Hertz tick_rate, const PathPlace& done)
      : link_(link), tick_rate_(tick_rate), done_(done) {}

  // The watcher sees each item that the board has reported as executed, including tails that were played.
  void watch_executed(std::function<void(const LinkItem&)> watcher) { played_.watch(std::move(watcher)); }
  // The watcher sees the motion that the board has executed, tails that were played included. Motion that was planned
  // and then planned anew is shown as it was executed.
  void watch_motion(std::function<void(const MotionItem&)> watcher) { motion_played_.watch(std::move(watcher)); }
  // The watcher is told before each refill where the board may come to rest from then on.
  void watch_rests(std::function<void(const BoardRest&)> watcher) { rest_watcher_ = std::move(watcher); }

  // To where the planner has given motion, and how far the board has executed it. What is given again after a rest that
  // came too early takes the place of what was not executed.
  Seconds given_time() const { return given_in_all_; }
  Seconds executed_time() const;
  // How often a tail was played to its end and the path was taken up again there.
  int recoveries() const { return counts_.recoveries; }
  // How often the speed was limited because a tail was long.
  int slowdowns() const { return counts_.slowdowns; }
  // How many of the items sent belonged to tails.
  std::uint64_t tail_items() const { return counts_.tail_items; }
  std::uint64_t refills() const { return counts_.refills; }
  // The longest motion, without the tail, that the board had while each refill waited for an answer. After a contact
  // the board has at most twice as much: the answer that the probe is free is no older than that.
  Seconds longest_ahead() const { return longest_ahead_; }

  // The planner has given this motion.
  void record_given(const MotionItem& motion, Seconds time);
  const PlayedMotion& motion_played() const { return motion_played_; }
  // Before a refill is sent, or outputs alone: from then on, the board comes to rest there.
  void report_rest(ItemNumber executed, const PathPlace& place) const;
  void record_motion(const LinkItem& item, ItemNumber number, Seconds time);
  void record_refill(Refill refill);  // after its motion
  // A refill waits for an answer now.
  void on_question();
  // Outputs that were sent alone are switched.
  void show(const BoardOutputs& outputs) const { played_.show(outputs); }

  // The board has told that it has executed so much. `done`: the board is known to be at least there.
  void on_executed(ItemNumber executed);
  // The refill that the board plays: it has begun no other. Null: none.
  const Refill* under_way() const { return under_way_.empty() ? nullptr : &under_way_.front(); }
  // The board has executed the refill under way, with its tail or without. Returns the rest that it came to.
  RestOnPath end_refill(bool on_tail);
  void on_recovery() { ++counts_.recoveries; }
  void set_slowdowns(int slowdowns) { counts_.slowdowns = slowdowns; }
  // The board rests, and all that was sent is executed.
  void record_rest();
  // The board rests. All that was sent after the rest never will be executed.
  void forget_unexecuted();

  // How much motion is sent and not executed, counted in whole items; and without the item that is played now, because
  // the board may be at its end.
  Seconds ahead() const { return ahead_; }
  Seconds surely_ahead() const { return motion_.empty() ? ahead_ : ahead_ - motion_.front().time; }
  // The same, as the board last told with the spindle's place.
  const std::optional<Seconds>& told_ahead() const { return told_ahead_; }
  void forget_told() { told_ahead_.reset(); }
  // Of all motion given. The answer tells the event at which the board was at `time`.
  Seconds ahead_of(const Turned& turned, Seconds time);
  // When the motion under way began, by the board's clock.
  const std::optional<Seconds>& began() const { return began_; }
  // The time of the item's first `of_events` events.
  Seconds time_of(const LinkItem& item, int of_events = most_events) const;

 private:
  struct Motion {
    ItemNumber number = 0;
    Seconds time{0};
    Seconds end{0};  // since the last rest
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
  std::function<void(const BoardRest&)> rest_watcher_;
  std::deque<Motion> motion_;     // sent and not executed
  std::deque<Refill> under_way_;  // the board plays the first
  PathPlace done_;                // up to here the board is known to have executed
  Seconds ahead_{0};
  Seconds given_time_{0};  // all motion since the last rest that the planner gave
  Seconds sent_time_{0};   // the part of given_time_ that was sent
  Seconds given_in_all_{0};
  Seconds passed_{0};       // all motion that was executed before the last rest
  Seconds item_begins_{0};  // when the board began its present item, as far as is known
  std::optional<Seconds> told_ahead_;
  std::optional<Seconds> began_;
  Seconds longest_ahead_{0};
  Counts counts_;
};

}  // namespace passo
