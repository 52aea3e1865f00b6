// MotionDrive: turns a path into steps on a board. The motion may be held, resumed, changed in speed or stopped at any
// instant.
//
// The second half of the pipeline: planner, step generator, feed, link. Motion emitted by the planner is committed and
// executed unchanged. After a change, the planner plans again from the end of the committed motion, on the path and
// within the limits. Thus a change takes effect after the committed time. Each part has one task: MotionPipeline has
// the stages, the feed transfers items to the board, PlannerHolds has the hold reasons, OutputSequencer switches
// outputs during a pause, ProbeMove evaluates the probe, SpindleTracker synchronises motion with the spindle.
//
// No function of a drive waits. advance() does what can be done now. When advance() returns `waits`, the owner lets the
// board continue with poll() or wait(). See docs/decisions/0017 and 0065.
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
#include "passo/drive/output_sequencer.hpp"
#include "passo/drive/planner_holds.hpp"
#include "passo/drive/probe_move.hpp"
#include "passo/drive/queue_update_ledger.hpp"
#include "passo/drive/script.hpp"
#include "passo/drive/spindle_tracker.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/link/board_session.hpp"

namespace passo {

class MotionDrive {
 public:
  enum class State : std::uint8_t {
    running,
    holding,  // decelerating for a hold, after the committed motion and where the program enables holds
    held,     // stopped on the path; see holds() for the reason
    ended,    // the path is done or stopped, or the link has an error
  };
  enum class Progress : std::uint8_t { goes_on, waits, ended };

  // `path`, `board` and `answers` must outlive the drive. The handshake with the board is complete, and no other drive
  // uses the board at the same time. The drive writes the machine's results into `answers`.
  MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps, BoardSession& board,
              StoredResults& answers, const DriveOptions& options = {});
  ~MotionDrive();

  // Does all work that needs no waiting.
  Progress advance();
  // Calls advance() and, if the drive waits, wait(). Returns false when the drive has ended. In a hold, virtual time
  // passes for `most`; with an endless `most`, no time passes.
  bool poll(Seconds most = Seconds(std::numeric_limits<double>::infinity()));
  // Lets the board continue until there is a message from it, but for at most `most`.
  void wait(Seconds most);

  State state() const { return state_; }
  const HoldReasons& holds() const { return holds_.reasons(); }
  // The outputs as commanded by the program and the operator.
  OutputState outputs() const { return outputs_.in_force(); }
  // The time on the board's side.
  Seconds now() const { return board_.now(); }
  // The time of the motion that is planned and not executed yet. It can no longer be changed.
  Seconds committed() const { return feed_->ahead(); }

  // Stops the machine on the path, as soon as the limits and the program (M53) allow. The hold lasts until resume()
  // removes the same reason.
  void hold(HoldReason reason = HoldReason::operator_hold);
  void resume(HoldReason reason = HoldReason::operator_hold);
  // The stop or tool change at which the program waits, if any. done() continues the program.
  const std::optional<Action>& waits_for() const { return waits_for_; }
  // The number of stops and tool changes that the motion has reached, including those without a wait for the operator.
  std::uint64_t stops() const { return stops_; }
  void done();
  // From now on the program waits at M1, or only stops there for a moment.
  void wait_at_optional(bool waits) { waits_at_optional_ = waits; }
  // Holds after each line of the program (single block). During motion it also stops now, because lines are planned
  // ahead.
  void stop_at_lines(bool wanted);
  // Stops, and drops the path up to its next action. The next item of the path's source must be an action.
  void drop();
  // Only for a board without a link. Continues a path that ended with an action await_line, which is dropped. Returns
  // false, and changes nothing, if the stop there can no longer be avoided.
  bool pass_await_line(PathMode last);
  // For a board on a link, after a drop(): the position of the stop. Empty: the end of the planned motion.
  const std::optional<Point>& dropped_to() const { return dropped_to_; }
  // Multiplies feeds by both factors where the program enables them (M48 to M50, M52). The operator's factor is 0 to 2,
  // the machine's 0 to 1. While the factors reduce the feed below a hundredth, the motion is held.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // Multiplies the speed of rapids; above 0, at most 1.
  void set_rapid_override(double factor) { pipeline_.planner().set_rapid_override(factor); }
  // Switches the coolant for the operator. The setting is valid until the program switches the same output.
  void switch_mist(bool on);
  void switch_flood(bool on);
  // Only during a hold, at standstill: stops the spindle, or the spindle and the coolant. Before motion continues,
  // everything is switched on again, with a wait for the spindle.
  void stop_spindle(bool stands);
  void stop_outputs();
  // Multiplies the spindle speed by `factor`, 0 to 2, where the program enables it (M48, M49, M51).
  void set_spindle_override(double factor);
  // Holds and ends the drive: the remaining path is dropped, a dwell is cut short, and the outputs are switched off.
  void stop();
  bool stopped() const { return holds_.has(HoldReason::stop); }
  // Returns true if the drive stopped because of a probe contact outside a probe move.
  bool stopped_by_probe() const { return stopped_by_probe_; }
  // Only with stop ramps (tails), before the first advance(). Switches the outputs on as required at the start of the
  // path: the spindle first, then the wait, then the other outputs.
  void switch_on(const OutputState& outputs, Seconds spindle_wait);
  // How often the board had switched its outputs off because it received nothing from the host.
  int output_timeouts() const { return output_timeouts_; }

  // For observers of probe results. Add observers before the first advance().
  ProbeMove& probe() { return probe_; }

  // Taps for observers of motion and items. Add observers before the first advance().
  Tap<MotionItem>& motion() { return pipeline_.motion(); }
  Tap<BoardItem>& items() { return pipeline_.items(); }
  // The sent and executed items of queue updates; null: the drive does not use queue updates.
  QueueUpdateLedger* ledger() { return feed_->ledger(); }
  const QueueUpdateLedger* ledger() const { return feed_->ledger(); }
  const BoardSession& link() const { return board_; }
  // The board's position, for the next drive on this board. Valid at standstill, after the end.
  BoardPosition place() const { return pipeline_.generator().place(); }
  // The axes whose backlash is then taken up for motion in the negative direction.
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
  void await_speed();
  void leave_hold();
  void reverse_tap(const Action& action);
  void wait_for_operator(const Action& action);
  void await_line();
  void check_probe();
  Attention attention() const;
  void change_feed();
  void come_to_rest();
  void rest_at_line();
  void stop_in_hold();
  void lose_thread();
  void send_outputs();
  void switch_off_and_end(std::optional<LinkError> error);
  Progress end();
  Seconds due() const;

  BoardSession& board_;
  StoredResults& answers_;
  MotionPipeline pipeline_;  // path -> board segments
  CommandedOutputs outputs_;
  std::unique_ptr<Feed> feed_;  // board segments -> wire
  ProbeMove probe_;
  SpindleTracker spindle_;
  Script script_;  // the steps to do during a stop
  OutputSequencer switching_;
  int output_timeouts_ = 0;
  // What the script waits for that a stop need not wait for.
  enum class Awaited : std::uint8_t { nothing, index, speed } awaited_ = Awaited::nothing;

  State state_ = State::running;
  PlannerHolds holds_;
  std::optional<Action> waits_for_;
  std::uint64_t stops_ = 0;
  bool waits_at_optional_;
  bool reads_again_ = false;  // at the next stop, because lines were planned ahead
  bool stopped_by_probe_ = false;
  std::optional<Point> dropped_to_;
  Point end_of_tap_;  // end of the committed motion
};

// Why the connected board cannot drive a machine with these step options, as a sentence without a full stop. Empty: it
// can.
std::optional<std::string> unsuited(const BoardSession& board, const StepOptions& steps, bool wants_encoder);

}  // namespace passo
