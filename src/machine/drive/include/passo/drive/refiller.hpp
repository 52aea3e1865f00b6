// Refiller: keeps the board's list of items filled, so that the list always ends at rest. When a refill comes too late,
// the machine comes to rest, and the refiller goes on from there.
//
// Place on the street: between the step generator and the link. A refill is some more motion and a tail. The tail is
// the motion that brakes the machine to rest on the path from there. The refill replaces the tail before, as a whole or
// not at all. For the tail, the planner tells how it would brake, and a fork of the step generator makes that into
// items. Planner and generator then go on as if nothing had been asked.
//
// A tail must fit into the board. A tail is long round tight bends or over many short segments. There the refiller
// limits the speed before the tail no longer fits. When not even the first tail of a stretch fits, the machine waits
// and begins the stretch more slowly.
//
// The board tells the numbers of the items that it has executed. From them the refiller knows which tail was played, if
// any. For each tail that may be played, the refiller remembers where on the path the tail ends and the fork's state
// there. The refiller plans anew from that place, from rest, so no step is lost or made twice. Why a refill was late or
// a line was broken makes no difference.
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
#include "passo/drive/played_items.hpp"
#include "passo/drive/played_motion.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/drive/speed_for_tails.hpp"
#include "passo/link/link.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

struct TailOptions {
  Seconds horizon{0.1};          // motion before the tail, after a refill
  Seconds refill_at{0.06};       // the next refill is sent when this much motion is left
  Seconds time_an_item{0.0005};  // time on the line; a refill with many items is sent sooner
  Seconds longest_move{0.005};   // no planned move is longer
  // How exact the segments are. Segments exact to the tick would, in the first milliseconds after a rest, be hundreds a
  // second more than a line can carry. They would also be more than a board with few places can hold. Boards with fewer
  // places than `few_places`, and motion in haste, get the kind "in few places".
  std::size_t few_places = 100;
  // On a board with fewer places tails have no limits of jerk: with them a tail has two or three times as many items,
  // which a small board also takes slowly (decision 0108).
  std::size_t places_for_gentle_tails = 200;
  Exactness motion{.one_in = 64, .longest_segment = longest_segment_of_all};
  Exactness motion_in_few_places{.one_in = 2, .least_rate = Hertz(1'000), .longest_segment = longest_segment_of_all};
  // A segment that is off by a whole interval may brake twice as hard where it begins as where it ends.
  Exactness tail{.one_in = 4, .least_rate = Hertz(0), .longest_segment = longest_segment_of_all, .ends_in_time = false};
  Exactness tail_in_few_places{
      .one_in = 1, .least_rate = Hertz(0), .longest_segment = longest_segment_of_all, .ends_in_time = false};
};

class Refiller final : public Feed {
 public:
  // The stages above and below the refiller. All outlive the refiller.
  struct Stages {
    RewindablePath& path;
    Planner& planner;
    StepGenerator& generator;
    Source<BoardItem>& items;  // the generator's, seen by those who watch
    Link& link;
    OutputsOrder& outputs;
  };
  // `waits_for_operator`: the drive carries out the program's stops.
  Refiller(const Stages& stages, const StepOptions& steps, const TailOptions& options, bool waits_for_operator = false);

  // Sends a refill, or tells what the refiller waits for.
  Turn advance() override;
  bool plans() const override { return true; }
  Action take_action() override;
  void watch(const MotionItem& motion) override;
  void attend(Attention attention) override;
  void pass_on_outputs() override { outputs_changed_ = true; }
  void switch_outputs(const BoardOutputs& outputs) override;
  bool settled() override;

  // The time of the motion ahead, without the tail.
  Seconds ahead() const override { return ahead_ + pulled_time_; }
  // On a clock of motion alone, which stands while nothing moves: to where the planner has given motion, and how far
  // the board has executed it. What is given again after a rest that came too early takes the place of what was not
  // executed.
  Seconds given_time() const { return given_in_all_; }
  Seconds executed_time() const;
  // Before the next advance().
  Seconds ahead_of(const Turned& turned, Seconds time) override;
  std::optional<Seconds> began() const override { return began_; }
  bool is_remote() const override { return true; }
  void note_rest(Seconds /*time*/) override {}

  // From here on no refill replaces the tail that the board has. The board plays that tail, and the path is taken up
  // again where the tail ends.
  void brake() override { brakes_ = true; }
  bool plays_tail() const override { return on_tail_ && !brakes_; }
  std::optional<Point> drop() override;
  void read_again() override;
  void cut_dwell() override { stages_.generator.cut_dwell(); }

  // A tail that is played in a part that follows the spindle by place ends the whole path.
  void guard_threads() { guards_threads_ = true; }
  // The longest motion, without the tail, that the board had while each refill waited for an answer. After a contact
  // the board has at most twice as much: the answer that the probe is free is no older than that.
  Seconds longest_ahead() const { return longest_ahead_; }

  // The watcher sees each item that the board has reported as executed, including tails that were played.
  void watch_executed(std::function<void(const LinkItem&)> watcher) { played_.watch(std::move(watcher)); }
  // The watcher sees the motion that the board has executed, tails that were played included. Motion that was planned
  // and then planned anew is shown as it was executed.
  void watch_motion(std::function<void(const MotionItem&)> watcher) { motion_played_.watch(std::move(watcher)); }
  // The watcher is told before each refill where the board may come to rest from then on.
  void watch_rests(std::function<void(const BoardRest&)> watcher) { rest_watcher_ = std::move(watcher); }
  // How often a tail was played to its end and the path was taken up again there.
  int recoveries() const { return recoveries_; }
  // How often the speed was limited because a tail was long.
  int slowdowns() const { return speed_.slowdowns(); }
  // How many of the items sent belonged to tails.
  std::uint64_t tail_items() const { return tail_items_; }
  std::uint64_t refills() const { return refills_; }

 private:
  struct Motion {
    ItemNumber number = 0;
    Seconds time{0};
    Seconds end{0};  // since the last rest
    LinkItem item = {};
  };
  // A place on the path where the machine rests, and the generator and the outputs there.
  struct Rest {
    PathPlace place = {};
    std::unique_ptr<StepGenerator> generator = {};
    OutputsOrder outputs = {};
  };
  // The motion of a tail, for those who watch what is executed.
  struct PlannedTail {
    std::uint64_t from = 0;  // after so many items of the motion
    std::vector<PlannedMove> moves = {};
  };
  struct Refill {
    ItemNumber first = 0;
    ItemNumber last_of_motion = 0;
    ItemNumber last = 0;  // the tail's last item; without a tail, the motion's
    PathPlace from = {};  // where its tail begins; no later refill rests before this place
    Rest rest = {};       // after the refill
    PlannedTail tail = {};
  };

  // How the machine would come to rest. At rest the tail has no items.
  struct Tail {
    PathPlace from = {};
    Rest rest = {};
    std::vector<LinkItem> items = {};
    PlannedTail motion = {};
  };
  struct Pulled {
    LinkItem item;
    Seconds time{0};
    SpeedForTails::Speed speed = {};  // about the speed at its end
    std::optional<Tail> tail = {};    // after the item; empty: no refill may end here
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
  void take_up();
  void pull();
  void add(const LinkItem& item);
  bool is_far_from_last_tail() const;
  Tail find_tail();
  Tail tail_of_nothing();
  std::unique_ptr<StepGenerator> fork();
  bool begin_more_slowly();
  std::size_t free_places() const;
  std::size_t size_of_refill();
  void send(std::size_t items);
  void ask();
  // The time of the item's first `of_events` events.
  Seconds time_of(const LinkItem& item, int of_events = most_events) const;

  Stages stages_;
  StepOptions steps_;
  TailOptions options_;

  std::deque<Motion> motion_;             // sent and not executed
  std::deque<Refill> refills_under_way_;  // the board plays the first, and has begun no other
  ItemNumber behind_ = 0;                 // the next refill goes after this item
  std::size_t places_;                    // the places for items that we use on the board
  PlayedItems played_;
  PlayedMotion motion_played_;
  std::function<void(const BoardRest&)> rest_watcher_;
  Seconds ahead_{0};
  Seconds given_time_{0};  // all motion since the last rest that the planner gave
  Seconds sent_time_{0};   // the part of given_time_ that was sent
  Seconds given_in_all_{0};
  Seconds passed_{0};       // all motion that was executed before the last rest
  Seconds item_begins_{0};  // when the board began its present item, as far as is known
  std::optional<Seconds> told_ahead_;
  std::optional<Seconds> began_;  // by the board's clock
  PathPlace given_;               // up to here the planner has given motion
  PathPlace done_;                // up to here the board is known to have executed
  Rest rested_;                   // the last rest
  SpeedForTails speed_;
  bool on_tail_ = false;  // the board plays a tail: nothing is sent before it rests

  std::deque<Pulled> pulled_;  // pulled and not sent
  Seconds pulled_time_{0};
  bool holds_ = false;            // after the pulled items, the planner holds
  bool ended_ = false;            // after the pulled items, the path has ended
  std::optional<Action> action_;  // after the pulled items, this is to be done

  Attention attention_ = Attention::none;
  Seconds answer_{0};  // how long the answer takes to a question sent with a refill
  Seconds slowest_answer_{0};
  bool asked_ = false;                                      // a question was asked, and its answer is not yet seen
  Seconds longest_move_{0};                                 // what the planner was told
  Seconds reach_{std::numeric_limits<double>::infinity()};  // a shorter horizon, for a while
  bool brakes_ = false;
  bool guards_threads_ = false;
  std::optional<PathPlace> before_action_;  // the action taken last, while nothing was sent since
  bool waits_for_operator_;
  bool outputs_changed_ = false;               // the board still has to hear of the change
  std::optional<BoardOutputs> switched_ = {};  // sent alone, and not known to be switched
  Seconds longest_ahead_{0};

  BoardItem item_;
  std::vector<PlannedMove> plan_;
  std::vector<LinkItem> items_;  // the items of a refill
  int recoveries_ = 0;
  std::uint64_t tail_items_ = 0;
  std::uint64_t refills_ = 0;
};

}  // namespace passo
