// MotionDrive: turns a path into steps on a board. The motion may be held, resumed, changed in speed or stopped at any
// instant.
//
// The lower half of the street: planner, step generator, feed, link. Motion that the planner has given is committed and
// played unchanged. A change makes the planner plan anew from the end of the committed motion, on the path and within
// the limits. So a change takes effect after the committed time. Each part has one task: MotionPipeline has the stages,
// the feed brings items to the board, PlannerHolds know why the machine is to rest, OutputsAtRest switches outputs in a
// pause, ProbeMove tells what the probe finds, SpindleTracker keeps motion in step with the spindle.
//
// No function of a drive waits. advance() does what can be done now. When advance() returns `waits`, the owner lets the
// board go on with poll() or wait(). See docs/decisions/0017 and 0065.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "passo/base/source.hpp"
#include "passo/base/tap.hpp"
#include "passo/drive/drive_options.hpp"
#include "passo/drive/motion_pipeline.hpp"
#include "passo/drive/outputs_at_rest.hpp"
#include "passo/drive/planner_holds.hpp"
#include "passo/drive/probe_move.hpp"
#include "passo/drive/refill_ledger.hpp"
#include "passo/drive/script.hpp"
#include "passo/drive/spindle_tracker.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/link/board_session.hpp"

namespace passo {

class MotionDrive {
 public:
  enum class State : std::uint8_t {
    running,
    holding,  // braking for a hold, after the committed motion and where the program heeds holds
    held,     // at rest on the path; holds() tells why
    ended,    // the path is done or stopped, or the link has an error
  };
  enum class Progress : std::uint8_t { goes_on, waits, ended };

  // `path`, `board` and `answers` outlive the drive. The board has been greeted, and no other drive uses it meanwhile.
  // The drive writes what the machine finds on the way into `answers`.
  MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps, BoardSession& board,
              AnswerBook& answers, const DriveOptions& options = {});
  ~MotionDrive();

  // Does what can be done without waiting.
  Progress advance();
  // Calls advance() and, where the drive waits, wait(). False when the drive has ended. In a hold, virtual time passes
  // for as long as `most`; with an endless `most`, no time passes.
  bool poll(Seconds most = Seconds(std::numeric_limits<double>::infinity()));
  // Lets the board go on until there is news, but no longer than `most`.
  void wait(Seconds most);

  State state() const { return state_; }
  const HoldReasons& holds() const { return holds_.reasons(); }
  // The outputs as the program and the operator have ordered them.
  OutputState outputs() const { return outputs_.in_force(); }
  // The time on the board's side.
  Seconds now() const { return board_.now(); }
  // How long the motion lasts that is planned and not played yet. Nothing can be changed for that time.
  Seconds committed() const { return feed_->ahead(); }

  // Brings the machine to rest on the path, as soon as the limits and the program (M53) allow. The hold lasts until
  // resume() takes back the same reason.
  void hold(HoldReason reason = HoldReason::operator_hold);
  void resume(HoldReason reason = HoldReason::operator_hold);
  // The stop or tool change that the program waits at, if any. done() lets the program go on.
  const std::optional<Action>& waits_for() const { return waits_for_; }
  // How many stops and tool changes the motion has come to, those at which nobody was waited for too.
  std::uint64_t stops() const { return stops_; }
  void done();
  // From now on the program waits at M1, or rests there for a moment only.
  void wait_at_optional(bool waits) { waits_at_optional_ = waits; }
  // The machine rests in a hold after each line of the program (single block). Amid motion it also rests now, because
  // lines are planned ahead.
  void stop_at_lines(bool wanted);
  // Brakes to rest, and drops the rest of the path up to its next action. The source of the path is to have an action
  // next.
  void drop();
  // Only for a board without a line. The path goes on where it ended until now with an action await_line, which is
  // forgotten. Returns false, and changes nothing, once the machine comes to rest there in any case.
  bool pass_await_line(PathMode last);
  // Over a line, after a drop(): where the machine has come to rest. Empty: at the end of the motion given.
  const std::optional<Point>& dropped_to() const { return dropped_to_; }
  // Feeds are multiplied by both factors where the program heeds them (M48 to M50, M52). The operator's factor is 0 to
  // 2, the machine's 0 to 1. When the factors leave less than a hundredth of the feed, the motion
  // is held until they leave more.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // Multiplies the speed of rapids; above 0, at most 1.
  void set_rapid_override(double factor) { pipeline_.planner().set_rapid_override(factor); }
  // The operator's switches for coolant. They count until the program switches the same itself.
  void switch_mist(bool on);
  void switch_flood(bool on);
  // Only in a hold, at rest: stops the spindle, or the spindle and the coolant. Before motion goes on, everything is
  // switched on again, with a wait for the spindle.
  void stop_spindle(bool stands);
  void stop_outputs();
  // Multiplies the spindle's speed by `factor`, 0 to 2, where the program heeds it (M48, M49, M51).
  void set_spindle_override(double factor);
  // Holds and ends the drive: the rest of the path is dropped, a dwell is cut short, and the outputs are switched off.
  void stop();
  bool stopped() const { return holds_.has(HoldReason::stop); }
  // True: the drive stopped because the probe was touched outside a probe move.
  bool stopped_by_probe() const { return stopped_by_probe_; }
  // Only with tails, before the first advance(). Switches the outputs on as they are where the path begins: the spindle
  // first, then the wait, then the rest.
  void switch_on(const OutputState& outputs, Seconds spindle_wait);
  // How often the board had switched its outputs off because it did not hear the host.
  int output_timeouts() const { return output_timeouts_; }

  // For watchers of what probe moves find. Watchers are added before the first advance().
  ProbeMove& probe() { return probe_; }

  // For watchers of motion and items. Watchers are added before the first advance().
  Tap<MotionItem>& motion() { return pipeline_.motion(); }
  Tap<BoardItem>& items() { return pipeline_.items(); }
  // What was sent in refills and played of them; null: the drive sends none.
  RefillLedger* ledger() { return feed_->ledger(); }
  const RefillLedger* ledger() const { return feed_->ledger(); }
  const BoardSession& link() const { return board_; }
  // Where the board stands, for the next drive on this board. Valid at rest, after the end.
  BoardPlace place() const { return pipeline_.generator().place(); }
  // The axes whose backlash is then taken up for motion down.
  AxisSet downs() const { return pipeline_.generator().downs(); }

 private:
  void watch(const PathItem& item);
  void watch(const MotionItem& item);
  void pass_on_outputs();
  void watch_tap(const PlannedMove& move);
  bool follow();
  Progress handle(Feed::Progress turn);
  void act(const Action& action);
  void begin_probe(const Action& action);
  void end_probe(const Action& action);
  void await_index(const Action& action);
  void reverse_tap(const Action& action);
  void wait_for_operator(const Action& action);
  void await_line();
  void check_probe();
  Attention attention() const;
  void change_feed();
  void come_to_rest();
  void rest_at_line();
  void rest_in_hold();
  void lose_thread();
  void send_outputs();
  void switch_off_and_end(std::optional<LinkError> error);
  Progress end();
  Seconds due() const;

  BoardSession& board_;
  AnswerBook& answers_;
  MotionPipeline pipeline_;  // path -> board segments
  OutputsOrder outputs_;
  std::unique_ptr<Feed> feed_;  // board segments -> wire
  ProbeMove probe_;
  SpindleTracker spindle_;
  Script script_;  // the steps to do at rest
  OutputsAtRest switching_;
  int output_timeouts_ = 0;
  bool awaits_index_ = false;

  State state_ = State::running;
  PlannerHolds holds_;
  std::optional<Action> waits_for_;
  std::uint64_t stops_ = 0;
  bool waits_at_optional_;
  bool reads_again_ = false;  // at the next rest, because lines were planned ahead
  bool stopped_by_probe_ = false;
  std::optional<Point> dropped_to_;
  Point end_of_tap_;  // where the committed motion ends
};

// Why the greeted board cannot drive a machine with these step options, as a sentence without a full stop. Empty:
// nothing is in the way.
std::optional<std::string> unsuited(const BoardSession& board, const StepOptions& steps, bool wants_encoder);

}  // namespace passo
