// MotionDrive: a path becomes steps on a board, and may be held, resumed, changed in speed or stopped at any instant.
//
// The lower half of the street: planner, step generator, link. What the planner has given is committed: it is played as
// it is. What comes after is planned anew from there, on the path and within the limits, so that a change takes effect
// after the time that is committed. Without go_live() the drive reads ahead as far as the board's queue goes. Live,
// it commits at most the horizon and what one pull adds, two moves and what is waited for: 15 ms with the defaults.
//
// In a probe move the drive commits little more than it must, whether live or not. When the board tells of the contact
// it brakes on the path behind that, and drops the rest of the move.
//
// Virtual time passes only while the board plays: at rest it stands still, but in wait(). See docs/decisions/0017.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "passo/base/source.hpp"
#include "passo/controller/probe_move.hpp"
#include "passo/controller/refiller.hpp"
#include "passo/controller/rewindable_path.hpp"
#include "passo/controller/spindle_encoder.hpp"
#include "passo/controller/spindle_follower.hpp"
#include "passo/controller/tap.hpp"
#include "passo/link/board_link.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// How far ahead a live drive commits.
struct LiveOptions {
  Seconds horizon{0.05};        // nothing is added while as much is committed
  Seconds longest_move{0.005};  // the planner's moves end after this time
  friend bool operator==(const LiveOptions&, const LiveOptions&) = default;
};

// How a drive reaches its board: directly, or by a line that takes care.
struct BoardLine {
  BoardPort* port = nullptr;  // none: the machine itself
  LineCare care = {};
  bool real_time = false;  // no virtual machine is behind it: its time passes by itself

  // The two kinds that there are. `session` and `greeting`: LineCare's.
  static BoardLine to(VirtualLine& line);
  static BoardLine to_board(BoardPort& board, std::uint16_t session = 1, std::uint8_t greeting = 0);
};

// In a probe move: the tool goes on so long into what it touched, before it brakes.
inline constexpr LiveOptions probing_options{.horizon = Seconds(0.004), .longest_move = Seconds(0.001)};

class MotionDrive {
 public:
  enum class State : std::uint8_t {
    running,
    holding,  // brakes for a hold, after what is committed and where the program heeds holds
    held,     // at rest on the path, by a hold or a feed of nothing; advance() does nothing until that ends
    ended,    // the path is done, was stopped, or the link has an error
  };

  // `path` and `machine` outlive the drive, and no other drive uses the machine meanwhile.
  MotionDrive(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps, VirtualMachine& machine,
              const BoardLine& line = {});

  // Before the first advance().
  void go_live(const LiveOptions& options);
  // Before the first advance(): what the board holds ends at rest always, and the drive goes on from there when the
  // line was broken.
  void use_tails(const TailOptions& options);
  // Before use_tails(): the path is taken up there, where the machine rests, and what is in front was done before.
  void begin_at(const PathPlace& place);
  // With tails, before the first advance(): as outputs are there; the spindle first, and then it waits.
  void switch_on(const OutputState& outputs, Seconds spindle_wait);
  // Of tails; none is used without use_tails().
  const Refiller* refiller() const { return refiller_ ? &*refiller_ : nullptr; }
  Refiller* refiller() { return refiller_ ? &*refiller_ : nullptr; }

  // Who wants to know what probe moves find, before the first advance(); and whether a probe that is touched in another
  // move stops the drive.
  ProbeMove& probe() { return probe_; }
  void guard_by_probe();
  // Before the first advance(), behind use_tails(): the board has an encoder, and what is to follows the spindle.
  void use_encoder(int counts_per_turn);
  // Where the place is written at which a tap has turned round. Outlives it.
  void tell_tap(Point& rest) { tap_rest_ = &rest; }
  // That happened.
  bool stopped_by_probe() const { return stopped_by_probe_; }

  // Goes on a little: sends one board segment, or lets the board play one. False when it has ended.
  [[nodiscard]] bool advance();

  // Rest on the path, as soon as the limits and the program (M53) allow behind what is committed.
  void hold();
  void resume();
  bool hold_asked() const { return hold_asked_; }
  // Feeds times both factors, 0 to 2 by the operator and 0 to 1 by the machine, where the program heeds them (M48 to
  // M50, M52); rapids stay as they are. Below a hundredth it is held until there is more.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // The spindle's speed times `factor`, 0 to 2, where the program heeds it (M48, M49, M51), behind what is committed.
  void set_spindle_override(double factor);
  // A hold that ends the drive: the rest of the path is dropped, the outputs are switched off.
  void stop();
  bool stopped() const { return stopping_; }
  // Lets time pass while it is held.
  void wait(Seconds time);
  // The same, until something is switched on that the board tells of.
  void listen(Seconds most);
  // Asks how the board's switches are: amid motion it tells only when one goes on, and that may be lost.
  void ask() { link_.ask(); }
  // As BoardLink has them.
  std::uint16_t take_pressed() { return link_.take_pressed(); }
  std::uint16_t inputs() const { return link_.inputs(); }

  State state() const { return state_; }
  // Of the board's side.
  Seconds now() const { return port_.elapsed(); }
  // The motion that was planned and is not played yet: so long from now on nothing can be changed.
  Seconds committed() const { return refiller_ ? refiller_->ahead() : planned_ - (now() - rested_); }

  // Who wants to watch, before the first advance().
  Tap<MotionItem>& motion() { return watched_motion_; }
  Tap<BoardItem>& board() { return watched_board_; }
  const BoardLink& link() const { return link_; }
  // What keeps it from driving the board that it found, as a sentence without a full stop.
  std::optional<std::string> unsuited() const;

 private:
  Seconds in_seconds(Ticks ticks) const { return Seconds(static_cast<double>(ticks.count) / tick_rate_.value()); }
  bool advance_with_tails();
  void look_at(const PathItem& item);
  void watch(const MotionItem& item);
  void send(const BoardItem& item);
  void set_outputs(const OutputState& outputs);
  void await_index(const OutputState& outputs);
  void rehearse_start();
  Seconds time_to_index(Seconds answer);
  void begin_following();
  void follow_spindle();
  bool read_spindle();
  void mind_start();
  bool mind_encoder(Seconds longest);
  void note(const Turned& turned);
  bool lose_thread();
  void give_up(LinkError error);
  LiveOptions commits() const;
  void commit_ahead(const LiveOptions& options);
  void let_pass(Seconds time);
  void watch_tap(const PlannedMove& move);
  void turn_tap(const Action& action);
  void look_at_probe();
  void commit_to_asked();
  void begin_probe(const Action& action);
  void end_probe(const Action& action);
  void let_planner_go_on();
  void rest_in_feed_hold();
  void rest_in_hold();
  bool end();

  Hertz tick_rate_;
  VirtualMachine& machine_;
  BoardPort& port_;
  bool real_time_;
  Tap<PathItem> watched_path_;
  RewindablePath path_;
  Planner planner_;  // segments -> phases
  Tap<MotionItem> watched_motion_;
  StepGenerator step_generator_;  // phases -> board segments
  Tap<BoardItem> watched_board_;
  BoardLink link_;  // board segments -> wire
  StepOptions steps_;
  std::optional<Refiller> refiller_;
  ProbeMove probe_;

  BoardItem item_;
  State state_ = State::running;
  bool hold_asked_ = false;
  bool stopping_ = false;
  bool contact_seen_ = false;  // of what the board watches for now
  bool probe_brakes_ = false;  // after a contact, until the path is at rest
  bool stopped_by_probe_ = false;
  std::optional<Point> end_of_probe_;  // where the motion in a probe move ends, if that is not the end of the move
  Point* tap_rest_ = nullptr;
  Point end_of_tap_;        // of the motion that is committed
  bool tap_turns_ = false;  // the spindle was told to turn round
  bool tap_brakes_ = false;
  double feed_override_ = 1;
  double adaptive_feed_ = 1;
  double spindle_override_ = 1;
  OutputState outputs_;                   // as the program has them
  bool heeds_spindle_override_ = true;    // where it is
  std::optional<BoardOutputs> on_board_;  // what was sent
  LiveOptions live_{.horizon = Seconds(std::numeric_limits<double>::infinity()),
                    .longest_move = Seconds(std::numeric_limits<double>::infinity())};
  LiveOptions ahead_ = live_;  // less while a spindle is followed
  SpindleEncoder encoder_;
  SpindleFollower follower_;
  bool encoder_known_ = false;  // to be right
  bool follows_ = false;        // the spindle, or is about to
  // By the board's clock, when the next thread is to begin; and how much later than by that the one before did.
  std::optional<Seconds> index_time_;
  Seconds late_{0};
  int looks_at_start_ = 0;
  std::optional<LinkError> trouble_;  // with which the drive ends when it has come to rest
  Seconds planned_{0};                // time of all motion given by the planner
  Seconds rested_;                    // time of the machine that was no motion of this drive
};

}  // namespace passo
