// Refiller: keeps the board's list filled so that it always ends at rest, and goes on where the machine came to rest
// when it could not.
//
// Place on the street: between the step generator and the link. A refill is some more motion and a tail: how the
// machine would brake to rest on the path from there. It takes the place of the tail before, as a whole or not at all.
// For the tail the planner tells how it would brake, and a fork of the step generator what that would be on the board;
// both go on as if nothing had been asked.
//
// A tail must fit into the board. Where it is long, round tight bends or over many short segments, the speed is limited
// before it no longer fits; and where not even the first of a stretch fits, the machine waits and begins it more
// slowly.
//
// Which tail was played, if one was, the board tells by the numbers of the items that it has executed. The refiller
// remembers of each tail that may be played where on the path it ends and the fork's state there. From that place it
// plans anew, from rest: no step is lost or made twice. Why a refill was late, or a line broken, makes no difference.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/drive/feed.hpp"
#include "passo/drive/outputs_order.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/link/link.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

struct TailOptions {
  Seconds horizon{0.1};          // of motion before the tail, behind a refill
  Seconds refill_at{0.06};       // so much of it being left, the next one is sent
  Seconds time_an_item{0.0005};  // on the line: one with many items is sent sooner
  Seconds longest_move{0.005};   // the planner's moves end after this time: what the tail plays before it brakes
  // Exact to the tick, the first milliseconds behind a rest would take hundreds of segments a second more than a line
  // can carry; and more than a board has places for that has few.
  std::size_t few_places = 100;
  Exactness motion{.one_in = 64, .longest_segment = longest_segment_of_all};
  Exactness motion_in_few_places{.one_in = 2, .least_rate = Hertz(1'000), .longest_segment = longest_segment_of_all};
  // Off by a whole interval, a segment may brake twice as hard where it begins as where it ends.
  Exactness tail{.one_in = 4, .least_rate = Hertz(0), .longest_segment = longest_segment_of_all};
  Exactness tail_in_few_places{.one_in = 1, .least_rate = Hertz(0), .longest_segment = longest_segment_of_all};
};

class Refiller final : public Feed {
 public:
  // What is above and below the refiller. All outlive it.
  struct Stages {
    RewindablePath& path;
    Planner& planner;
    StepGenerator& generator;
    Source<BoardItem>& items;  // the generator's, seen by those who watch
    Link& link;
    OutputsOrder& outputs;
  };
  // `waits_for_operator`: the program's stops are the drive's to do.
  Refiller(const Stages& stages, const StepOptions& steps, const TailOptions& options, bool waits_for_operator = false);

  // Sends a refill, or tells what it waits for.
  Turn advance() override;
  bool plans() const override { return true; }
  Action take_action() override;
  void watch(const MotionItem& motion) override;
  void attend(Attention attention) override;
  void pass_on_outputs() override { outputs_changed_ = true; }
  void switch_outputs(const BoardOutputs& outputs) override;
  bool settled() override;

  // The tail does not count.
  Seconds ahead() const override { return ahead_ + pulled_time_; }
  // Before the next advance().
  Seconds ahead_of(const Turned& turned, Seconds time) override;
  std::optional<Seconds> began() const override { return began_; }
  bool is_remote() const override { return true; }
  void note_rest(Seconds /*time*/) override {}

  // No refill takes the place of the tail that the board has now, and the path is taken up again where the tail ends.
  void brake() override { brakes_ = true; }
  bool plays_tail() const override { return on_tail_ && !brakes_; }
  std::optional<Point> drop() override;
  void cut_dwell() override { stages_.generator.cut_dwell(); }

  // Where a tail is played in what follows the spindle by place, all ends.
  void guard_threads() { guards_threads_ = true; }
  // The longest motion that the board had, its tail besides, when questions came before refills. What the board had
  // behind a contact is at most twice as long: the answer that the probe is free is no older than that.
  Seconds longest_ahead() const { return longest_ahead_; }

  // Who wants to see each item that the board has told to have executed, tails that were played included.
  void watch_executed(std::function<void(const LinkItem&)> watcher) { executed_watcher_ = std::move(watcher); }
  // Who wants to be told, before a refill is sent, where the board may come to rest from then on.
  void watch_rests(std::function<void(const BoardRest&)> watcher) { rest_watcher_ = std::move(watcher); }
  // How often a tail was played to its end, and the path taken up again there.
  int recoveries() const { return recoveries_; }
  // How often the speed was limited since a tail was long.
  int slowdowns() const { return slowdowns_; }
  // Of the items sent, those that were tails.
  std::uint64_t tail_items() const { return tail_items_; }
  std::uint64_t refills() const { return refills_; }

 private:
  struct Motion {
    ItemNumber number = 0;
    Seconds time{0};
    Seconds end{0};  // since the last rest
    LinkItem item = {};
  };
  struct Sent {
    ItemNumber number = 0;
    LinkItem item;
    std::optional<ItemNumber> end_of_tail = {};  // none: motion
  };
  // A place on the path where the machine rests, and the generator and the outputs there.
  struct Rest {
    PathPlace place = {};
    std::unique_ptr<StepGenerator> generator = {};
    OutputsOrder outputs = {};
  };
  struct Refill {
    ItemNumber first = 0;
    ItemNumber last_of_motion = 0;
    ItemNumber last = 0;  // of the tail; without one, of the motion
    PathPlace from = {};  // where its tail begins; no later one rests before
    Rest rest = {};       // behind it
  };

  // How the machine would come to rest. At rest there is nothing to it.
  struct Tail {
    PathPlace from = {};
    Rest rest = {};
    std::vector<LinkItem> items = {};
  };
  struct Pulled {
    LinkItem item;
    Seconds time{0};
    std::optional<Tail> tail = {};  // behind it; none: no refill ends here
  };

  void commit();
  bool counts_items() const;
  bool in_haste() const { return attention_ == Attention::probes || attention_ == Attention::follows; }
  bool may_plan();
  Seconds known_ahead() const;
  Seconds horizon() const;
  Seconds refill_at() const;
  bool waits_for_answer();
  void note_executed();
  void show_executed(ItemNumber executed);
  void take_up();
  void pull();
  void add(const LinkItem& item);
  bool is_far_from_last_tail() const;
  Tail find_tail();
  Tail tail_of_nothing();
  std::unique_ptr<StepGenerator> fork();
  void mind_length_of(const Tail& tail);
  bool begin_more_slowly();
  void limit_speed_to(double speed);
  std::size_t free_places() const;
  std::size_t size_of_refill();
  void send(std::size_t items);
  void ask();
  // Of so many events of it.
  Seconds time_of(const LinkItem& item, int of_events = most_events) const;

  Stages stages_;
  StepOptions steps_;
  TailOptions options_;

  std::deque<Motion> motion_;             // sent and not executed
  std::deque<Refill> refills_under_way_;  // the first is being played; of the others, nothing yet
  ItemNumber behind_ = 0;                 // the next refill goes behind this item
  std::size_t places_;                    // that the board has for items, as far as we use them
  std::function<void(const LinkItem&)> executed_watcher_;
  std::function<void(const BoardRest&)> rest_watcher_;
  std::deque<Sent> sent_;  // and not executed, for who watches
  Seconds ahead_{0};
  Seconds given_time_{0};  // of all motion since the last rest, by the planner
  Seconds sent_time_{0};   // and of what of that was sent
  std::optional<Seconds> told_ahead_;
  std::optional<Seconds> began_;                                  // by the board's clock
  PathPlace given_;                                               // by the planner
  double speed_ = 0;                                              // there
  double fastest_ = 0;                                            // since the last rest
  Rest rested_;                                                   // the last one
  std::size_t long_tail_;                                         // items: longer ones leave too few places
  double speed_limit_ = std::numeric_limits<double>::infinity();  // for the sake of them
  Seconds limited_for_{0};                                        // of motion that was pulled
  int slowdowns_ = 0;
  bool on_tail_ = false;  // the board plays one: nothing is sent before it rests

  std::deque<Pulled> pulled_;  // and not sent
  Seconds pulled_time_{0};
  bool holds_ = false;            // behind it, the planner holds
  bool ended_ = false;            // behind it, the path has ended
  std::optional<Action> action_;  // behind it, this is to be done

  Attention attention_ = Attention::none;
  Seconds answer_{0};  // within which a question that comes with a refill is answered
  Seconds slowest_answer_{0};
  bool asked_ = false;                                      // and the answer not seen
  Seconds longest_move_{0};                                 // as the planner was told
  Seconds reach_{std::numeric_limits<double>::infinity()};  // a shorter horizon, for a while
  bool brakes_ = false;
  bool guards_threads_ = false;
  std::optional<PathPlace> before_action_;  // that was taken last, while nothing has been sent since
  bool waits_for_operator_;
  bool outputs_changed_ = false;               // and the board is to hear of it
  std::optional<BoardOutputs> switched_ = {};  // sent by themselves, and not known to be done
  Seconds longest_ahead_{0};

  BoardItem item_;
  std::vector<PlannedMove> plan_;
  std::vector<LinkItem> items_;  // of a refill
  int recoveries_ = 0;
  std::uint64_t tail_items_ = 0;
  std::uint64_t refills_ = 0;
};

}  // namespace passo
