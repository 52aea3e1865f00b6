// MotionDrive: a path becomes steps on a board, and may be held, resumed, changed in speed or stopped at any instant.
//
// The lower half of the street: planner, step generator, link. What the planner has given is committed: it is played as
// it is. What comes after is planned anew from there, on the path and within the limits, so that a change takes effect
// after the time that is committed. Without go_live() the drive reads ahead as far as the board's queue goes. Live,
// it commits at most the horizon and what one pull adds, two moves and what is waited for: 15 ms with the defaults.
//
// Virtual time passes only while the board plays: at rest it stands still, but in wait(). See docs/decisions/0017.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "passo/base/source.hpp"
#include "passo/controller/refiller.hpp"
#include "passo/controller/rewindable_path.hpp"
#include "passo/controller/tap.hpp"
#include "passo/link/in_process_link.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// How far ahead a live drive commits.
struct LiveOptions {
  Seconds horizon{0.05};        // nothing is added while as much is committed
  Seconds longest_move{0.005};  // the planner's moves end after this time
};

// How a drive reaches its board: directly, or by a line that takes care.
struct BoardLine {
  BoardPort* port = nullptr;  // none: the machine itself
  LineCare care = {};
};

class MotionDrive {
 public:
  enum class State : std::uint8_t {
    running,
    holding,  // brakes for a hold, after what is committed
    held,     // at rest on the path; advance() does nothing until resume()
    ended,    // the path is done, was stopped, or the link has an error
  };

  // `path` and `machine` outlive the drive, and no other drive uses the machine meanwhile.
  MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps, VirtualMachine& machine,
              const BoardLine& line = {});

  // Before the first advance().
  void go_live(const LiveOptions& options);
  // Before the first advance(): what the board holds ends at rest always, and the drive goes on from there when the
  // line was broken. False, and without effect, where the planner cannot tell how it would brake.
  bool use_tails(const TailOptions& options);
  // Of tails; none is used without use_tails().
  const Refiller* refiller() const { return refiller_ ? &*refiller_ : nullptr; }

  // Goes on a little: sends one board segment, or lets the board play one. False when it has ended.
  [[nodiscard]] bool advance();

  // Rest on the path, as soon as the limits allow behind what is committed.
  void hold();
  void resume();
  // Feeds times `factor`, 0.01 to 2; rapids stay as they are.
  void set_feed_override(double factor) { planner_.set_feed_override(factor); }
  // A hold that ends the drive: the rest of the path is dropped, the outputs are switched off.
  void stop();
  // Lets time pass while it is held.
  void wait(Seconds time);

  State state() const { return state_; }
  // Of the virtual machine.
  Seconds now() const { return in_seconds(machine_.now()); }
  // The motion that was planned and is not played yet: so long from now on nothing can be changed.
  Seconds committed() const { return refiller_ ? refiller_->ahead() : planned_ - (now() - rested_); }

  // Who wants to watch, before the first advance().
  Tap<MotionItem>& motion() { return watched_motion_; }
  Tap<BoardItem>& board() { return watched_board_; }
  const InProcessLink& link() const { return link_; }

 private:
  Seconds in_seconds(Ticks ticks) const { return Seconds(static_cast<double>(ticks.count) / tick_rate_.value()); }
  bool advance_with_tails();
  void send(const BoardItem& item);
  void rest_in_hold();
  bool end();

  Hertz tick_rate_;
  VirtualMachine& machine_;
  RewindablePath path_;
  Planner planner_;  // segments -> phases
  Tap<MotionItem> watched_motion_;
  StepGenerator step_generator_;  // phases -> board segments
  Tap<BoardItem> watched_board_;
  InProcessLink link_;  // board segments -> wire
  StepOptions steps_;
  std::optional<Refiller> refiller_;

  BoardItem item_;
  State state_ = State::running;
  bool stopping_ = false;
  Seconds horizon_{std::numeric_limits<double>::infinity()};
  Seconds planned_{0};  // time of all motion given by the planner
  Seconds rested_;      // time of the machine that was no motion of this drive
};

}  // namespace passo
