// DirectFeed: sends board items to a board in this process, in order, as far ahead as the commitment allows. Nothing
// can be lost, so the feed only stores the motion that was planned ahead.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/feed_stages.hpp"

namespace passo {

class DirectFeed final : public Feed {
 public:
  using Stages = FeedStages;
  struct Options {
    Commitment live;
    bool follows_spindle = false;     // in the parts of the path that require it
    bool waits_for_operator = false;  // the drive performs the program's stops
    bool reads_again = false;         // read_again() may be called: the path keeps the items planned ahead
  };
  // All stages must outlive the feed.
  DirectFeed(const Stages& stages, const Options& options);

  Progress advance() override;
  bool plans() const override { return waiting_.empty() && !action_ && !ended_; }
  Action take_action() override { return *std::exchange(action_, std::nullopt); }
  void watch(const MotionItem& motion) override;
  void attend(Attention attention) override;
  void pass_on_outputs() override { waiting_.emplace_back(stages_.outputs.tell()); }
  void switch_outputs(const BoardOutputs& outputs) override { waiting_.emplace_back(outputs); }
  bool settled() override;
  Seconds ahead() const override { return planned_ - (stages_.link.now() - rested_); }
  Seconds ahead_of(const Turned& /*turned*/, Seconds /*time*/) override { return ahead(); }
  std::optional<Seconds> began() const override { return {}; }
  bool is_remote() const override { return false; }
  void record_rest(Seconds time) override { rested_ += time; }
  void brake() override {}
  bool plays_tail() const override { return false; }
  std::optional<Point> drop() override;
  void read_again() override;
  void cut_dwell() override;
  // From here on the feed does not read far ahead.
  void expect_thread() override;
  QueueUpdateLedger* ledger() override { return nullptr; }

 private:
  bool send_waiting();
  Commitment commitment() const;
  void apply(const Commitment& wanted);

  Stages stages_;
  Options options_;
  Commitment live_;   // while no event needs a fast reaction
  Commitment ahead_;  // the commitment last passed to the stages
  Attention attention_ = Attention::none;
  BoardItem item_;
  std::deque<LinkItem>
      waiting_;  // waiting for room on the board: an item, and outputs that changed while the item was made
  std::optional<Action> action_;
  bool ended_ = false;
  PathPosition given_;  // the end of the planned motion; only for read_again()
  Seconds planned_{0};  // total time of the planned motion
  Seconds rested_;      // the board's time during which this drive moved nothing
};

}  // namespace passo
