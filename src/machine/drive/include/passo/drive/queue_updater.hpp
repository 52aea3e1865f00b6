// QueueUpdater: keeps the board's queue filled, such that it always ends in a stop. If a queue update comes too late,
// the machine stops, and the refiller continues from there.
//
// Position in the pipeline: between the step generator and the link. A queue update (refill) consists of further motion
// and a stop ramp (tail). The stop ramp is the motion that stops the machine on the path from there. It replaces the
// previous stop ramp completely or not at all. PulledItems has the items of the next queue update, StopRampPlanner
// finds the stop ramps, QueueUpdatePacing determines when an update is due, and QueueUpdateLedger tracks sent and
// executed items.
//
// A stop ramp must fit into the board's queue. It is long in tight bends and on many short segments. There, the
// refiller limits the speed, so that the stop ramp fits. If not even the first stop ramp after a stop fits, the machine
// waits and starts more slowly.
//
// The board reports the numbers of the executed items. From them, the refiller determines which stop ramp was executed,
// if any. For each possible stop ramp, the ledger stores its end point on the path and the generator's state there. The
// refiller plans again from that stop point, so no step is lost or made twice. This works for any cause of a late queue
// update or a broken link.
#pragma once

#include <optional>
#include <vector>

#include "passo/drive/feed.hpp"
#include "passo/drive/feed_stages.hpp"
#include "passo/drive/pulled_items.hpp"
#include "passo/drive/queue_update_ledger.hpp"
#include "passo/drive/queue_update_pacing.hpp"
#include "passo/drive/stop_ramp_options.hpp"
#include "passo/drive/stop_ramp_planner.hpp"
#include "passo/drive/stop_ramp_speed_limiter.hpp"

namespace passo {

class QueueUpdater final : public Feed {
 public:
  using Stages = FeedStages;
  // All stages must outlive the refiller. `waits_for_operator`: the drive performs the program's stops.
  QueueUpdater(const Stages& stages, const StepOptions& steps, const StopRampOptions& options,
               bool waits_for_operator = false);

  // Sends a queue update, or returns what the refiller is waiting for.
  Progress advance() override;
  bool plans() const override { return true; }
  Action take_action() override;
  void watch(const MotionItem& motion) override;
  void attend(Attention attention) override;
  void pass_on_outputs() override { outputs_changed_ = true; }
  void switch_outputs(const BoardOutputs& outputs) override;
  bool settled() override;

  // The time of the motion ahead, without the stop ramp.
  Seconds ahead() const override { return ledger_.ahead() + pulled_.time(); }
  // Call before the next advance().
  Seconds ahead_of(const Turned& turned, Seconds time) override { return ledger_.ahead_of(turned, time); }
  std::optional<Seconds> began() const override { return ledger_.began(); }
  bool is_remote() const override { return true; }
  void record_rest(Seconds /*time*/) override {}

  // From here on, the board's stop ramp is not replaced. The board executes that stop ramp, and the path is continued
  // from its end.
  void brake() override { brakes_ = true; }
  bool plays_tail() const override { return on_tail_ && !brakes_; }
  std::optional<Point> drop() override;
  void read_again() override;
  void cut_dwell() override { stages_.generator.cut_dwell(); }

  void expect_thread() override {}

  // From now on, a stop ramp executed in a part that is locked to the spindle's angle ends the whole path.
  void guard_threads() { guards_threads_ = true; }
  QueueUpdateLedger* ledger() override { return &ledger_; }

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
  StopRampOptions options_;
  ItemNumber behind_ = 0;     // the next queue update replaces everything after this item
  std::size_t places_;        // the number of queue places used on the board
  QueueUpdateLedger ledger_;  // the sent items
  StopRampPlanner tails_;
  QueueUpdatePacing pace_;
  PulledItems pulled_;  // the items to send next
  PathPosition given_;  // the planner has emitted motion up to here
  StopOnPath rested_;   // the last stop
  StopRampSpeedLimiter speed_;
  bool on_tail_ = false;  // the board executes a stop ramp: nothing is sent until it has stopped
  bool brakes_ = false;
  bool guards_threads_ = false;
  std::optional<PathPosition> before_action_;  // the position before the last action, while nothing was sent since
  bool waits_for_operator_;
  bool outputs_changed_ = false;               // the board has not received the change yet
  std::optional<BoardOutputs> switched_ = {};  // sent separately, and not known to be switched
  BoardItem item_;
  std::vector<LinkItem> items_;  // the items of a queue update
};

}  // namespace passo
