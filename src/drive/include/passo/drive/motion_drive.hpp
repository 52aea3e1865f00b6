// MotionDrive: a path becomes steps on a board, and may be held, resumed, changed in speed or stopped at any instant.
//
// The lower half of the street: planner, step generator, feed, link. What the planner has given is committed: it is
// played as it is. What comes after is planned anew from there, on the path and within the limits, so that a change
// takes effect after the time that is committed. The parts hold one idea each: the feed brings items to the board,
// HoldReasons say why the machine is to rest, ProbeMove what the probe finds, SpindleTracker what follows the spindle.
//
// No function of a drive waits. advance() does what can be done now; where it says `waits` its owner lets the board
// go on, by turn() or wait(). See docs/decisions/0017 and 0065.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "passo/base/source.hpp"
#include "passo/base/tap.hpp"
#include "passo/drive/feed.hpp"
#include "passo/drive/holds.hpp"
#include "passo/drive/outputs_order.hpp"
#include "passo/drive/probe_move.hpp"
#include "passo/drive/refiller.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/drive/script.hpp"
#include "passo/drive/spindle_tracker.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/link/board_session.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class DirectFeed;

// How far ahead a drive commits that is to react at once. Without, it reads ahead as far as the board's queue goes.
inline constexpr Commitment live_commitment{.horizon = Seconds(0.05), .longest_move = Seconds(0.005)};
inline constexpr Commitment endless_commitment{.horizon = Seconds(std::numeric_limits<double>::infinity()),
                                               .longest_move = Seconds(std::numeric_limits<double>::infinity())};

struct DriveOptions {
  // What the board holds ends at rest always, and the drive goes on from there when the line was broken: for a board at
  // the end of a line. Without, items go to the board directly.
  std::optional<TailOptions> tails = {};
  Commitment live = endless_commitment;  // of a board without a line
  // Of a path that is begun amid it: all before was done by another host.
  std::optional<PathPlace> begin_at = {};
  int counts_per_turn = 0;          // of the spindle's encoder; 0: nothing follows the spindle
  bool guards_by_probe = false;     // a touch in a move that is no probe move stops the drive
  bool waits_for_operator = false;  // at the program's stops (M0, M1) and tool changes (M6)
};

class MotionDrive {
 public:
  enum class State : std::uint8_t {
    running,
    holding,  // brakes for a hold, after what is committed and where the program heeds holds
    held,     // at rest on the path; the reasons tell why
    ended,    // the path is done, was stopped, or the link has an error
  };
  enum class Turn : std::uint8_t { goes_on, waits, ended };

  // `path`, `board` and `answers` outlive the drive; the board is greeted, and no other drive uses it meanwhile. What
  // the machine finds on the way is written into `answers`.
  MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps, BoardSession& board,
              AnswerBook& answers, const DriveOptions& options = {});
  ~MotionDrive();

  // Does what can be done without waiting.
  Turn advance();
  // advance(), and where the drive waits the board goes on until there is news, but no longer than `most`. False when
  // the drive has ended. In a hold virtual time passes as far as `most` goes; endless, none does.
  bool turn(Seconds most = Seconds(std::numeric_limits<double>::infinity()));
  // Where the drive waits: the board goes on until there is news, but no longer than `most`.
  void wait(Seconds most);

  State state() const { return state_; }
  const HoldReasons& holds() const { return holds_; }
  // As the program has ordered them.
  const OutputState& outputs() const { return outputs_.ordered(); }
  // Of the board's side.
  Seconds now() const { return board_.now(); }
  // The motion that was planned and is not played yet: so long from now on nothing can be changed.
  Seconds committed() const { return feed_->ahead(); }
  // Of a board without a line, at any time.
  void go_live(const Commitment& live = live_commitment);

  // To rest on the path, as soon as the limits and the program (M53) allow, until the same reason is taken back.
  void hold(HoldReason reason = HoldReason::operator_hold);
  void resume(HoldReason reason = HoldReason::operator_hold);
  // What the program waits for, if it does: a stop or a tool change. done() lets it go on.
  const std::optional<Action>& waits_for() const { return waits_for_; }
  void done();
  // Feeds times both factors, 0 to 2 by the operator and 0 to 1 by the machine, where the program heeds them (M48 to
  // M50, M52); rapids stay as they are. Below a hundredth the motion is held until there is more.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // The spindle's speed times `factor`, 0 to 2, where the program heeds it (M48, M49, M51).
  void set_spindle_override(double factor);
  // A hold that ends the drive: the rest of the path is dropped, a dwell is cut short, the outputs are switched off.
  void stop();
  bool stopped() const { return holds_.has(HoldReason::stop); }
  // A probe that was touched in a move that is no probe move did it.
  bool stopped_by_probe() const { return stopped_by_probe_; }
  // With tails, before the first advance(): outputs as they are where the path begins; the spindle first, and the wait.
  void switch_on(const OutputState& outputs, Seconds spindle_wait);

  // Who wants to know what probe moves find, before the first advance().
  ProbeMove& probe() { return probe_; }

  // Who wants to watch, before the first advance().
  Tap<MotionItem>& motion() { return watched_motion_; }
  Tap<BoardItem>& items() { return watched_items_; }
  // Tail statistics; null: the drive has no tails.
  Refiller* refiller() { return refiller_; }
  const Refiller* refiller() const { return refiller_; }
  const BoardSession& link() const { return board_; }
  // At rest, at the end: where the board stands, for the next drive on it.
  BoardPlace place() const { return step_generator_.place(); }

 private:
  std::unique_ptr<Feed> make_feed(const DriveOptions& options, const StepOptions& steps);
  void watch(const PathItem& item);
  void watch(const MotionItem& item);
  void pass_on_outputs();
  void watch_tap(const PlannedMove& move);
  bool follow();
  Turn take(Feed::Turn turn);
  void act(const Action& action);
  void begin_probe(const Action& action);
  void end_probe(const Action& action);
  void await_index(const Action& action);
  void turn_tap(const Action& action);
  void wait_for_operator(const Action& action);
  void look_at_probe();
  Attention attention() const;
  void change_holds(HoldReason reason, bool holds);
  void tell_planner();
  void mind_feed();
  void come_to_rest();
  void rest_in_hold();
  void lose_thread();
  Turn end();
  Seconds due() const;

  BoardSession& board_;
  AnswerBook& answers_;
  Tap<PathItem> watched_path_;
  RewindablePath path_;
  Planner planner_;  // segments -> phases
  Tap<MotionItem> watched_motion_;
  StepGenerator step_generator_;  // phases -> board segments
  Tap<BoardItem> watched_items_;
  OutputsOrder outputs_;
  DirectFeed* direct_ = nullptr;  // of the feed, where it is one
  Refiller* refiller_ = nullptr;
  std::unique_ptr<Feed> feed_;  // board segments -> wire
  ProbeMove probe_;
  SpindleTracker spindle_;
  Script script_;  // what is being done at rest
  Seconds pause_end_{0};
  bool awaits_index_ = false;

  State state_ = State::running;
  HoldReasons holds_;
  bool planner_holds_ = false;  // as it was told
  bool planner_stops_ = false;
  std::optional<Action> waits_for_;
  double feed_override_ = 1;
  double adaptive_feed_ = 1;
  bool contact_seen_ = false;  // of what the board watches for now
  bool stopped_by_probe_ = false;
  std::optional<Point> end_of_probe_;  // where the motion in a probe move ends, if that is not the end of the move
  Point end_of_tap_;                   // of the motion that is committed
};

// What keeps a machine of such steps from being driven by the board that was greeted, as a sentence without a full
// stop.
std::optional<std::string> unsuited(const BoardSession& board, const StepOptions& steps, bool wants_encoder);

}  // namespace passo
