// Refiller: keeps the board's list of items filled, so that the list always ends at rest. When a refill comes too late,
// the machine comes to rest, and the refiller goes on from there.
//
// Place on the street: between the step generator and the link. A refill is some more motion and a tail. The tail is
// the motion that brakes the machine to rest on the path from there. The refill replaces the tail before, as a whole or
// not at all. PulledItems are what the next refill is made of, TailMaker finds the tails, RefillPace says when a refill
// is due, and RefillLedger knows what was sent and what the board has executed of it.
//
// A tail must fit into the board. A tail is long round tight bends or over many short segments. There the refiller
// limits the speed before the tail no longer fits. When not even the first tail of a stretch fits, the machine waits
// and begins the stretch more slowly.
//
// The board tells the numbers of the items that it has executed. From them the refiller knows which tail was played, if
// any. For each tail that may be played, the ledger remembers where on the path the tail ends and the generator's state
// there. The refiller plans anew from that place, from rest, so no step is lost or made twice. Why a refill was late or
// a line was broken makes no difference.
#pragma once

#include <optional>
#include <vector>

#include "passo/drive/feed.hpp"
#include "passo/drive/feed_stages.hpp"
#include "passo/drive/pulled_items.hpp"
#include "passo/drive/refill_ledger.hpp"
#include "passo/drive/refill_pace.hpp"
#include "passo/drive/speed_for_tails.hpp"
#include "passo/drive/tail_maker.hpp"
#include "passo/drive/tail_options.hpp"

namespace passo {

class Refiller final : public Feed {
 public:
  using Stages = FeedStages;
  // All stages outlive the refiller.
  // `waits_for_operator`: the drive carries out the program's stops.
  Refiller(const Stages& stages, const StepOptions& steps, const TailOptions& options, bool waits_for_operator = false);

  // Sends a refill, or tells what the refiller waits for.
  Progress advance() override;
  bool plans() const override { return true; }
  Action take_action() override;
  void watch(const MotionItem& motion) override;
  void attend(Attention attention) override;
  void pass_on_outputs() override { outputs_changed_ = true; }
  void switch_outputs(const BoardOutputs& outputs) override;
  bool settled() override;

  // The time of the motion ahead, without the tail.
  Seconds ahead() const override { return ledger_.ahead() + pulled_.time(); }
  // Before the next advance().
  Seconds ahead_of(const Turned& turned, Seconds time) override { return ledger_.ahead_of(turned, time); }
  std::optional<Seconds> began() const override { return ledger_.began(); }
  bool is_remote() const override { return true; }
  void record_rest(Seconds /*time*/) override {}

  // From here on no refill replaces the tail that the board has. The board plays that tail, and the path is taken up
  // again where the tail ends.
  void brake() override { brakes_ = true; }
  bool plays_tail() const override { return on_tail_ && !brakes_; }
  std::optional<Point> drop() override;
  void read_again() override;
  void cut_dwell() override { stages_.generator.cut_dwell(); }

  void expect_thread() override {}

  // A tail that is played in a part that follows the spindle by place ends the whole path.
  void guard_threads() { guards_threads_ = true; }
  RefillLedger* ledger() override { return &ledger_; }

 private:
  Progress advance_at_rest();
  void commit();
  bool counts_items() const;
  bool may_plan();
  Seconds known_ahead() const;
  bool waits_for_answer();
  void on_executed();
  void rewind();
  void pull();
  void add(const LinkItem& item);
  bool begin_more_slowly();
  std::size_t free_places() const;
  std::size_t size_of_refill();
  void send(std::size_t items);
  void ask();

  Stages stages_;
  TailOptions options_;
  ItemNumber behind_ = 0;  // the next refill goes after this item
  std::size_t places_;     // the places for items that we use on the board
  RefillLedger ledger_;    // what was sent
  TailMaker tails_;
  RefillPace pace_;
  PulledItems pulled_;  // what is sent next
  PathPlace given_;     // up to here the planner has given motion
  RestOnPath rested_;   // the last rest
  SpeedForTails speed_;
  bool on_tail_ = false;  // the board plays a tail: nothing is sent before it rests
  bool brakes_ = false;
  bool guards_threads_ = false;
  std::optional<PathPlace> before_action_;  // the action taken last, while nothing was sent since
  bool waits_for_operator_;
  bool outputs_changed_ = false;               // the board still has to hear of the change
  std::optional<BoardOutputs> switched_ = {};  // sent alone, and not known to be switched
  BoardItem item_;
  std::vector<LinkItem> items_;  // the items of a refill
};

}  // namespace passo
