// Feed: brings board items from the step generator to the board, either directly in this process or by refills over a
// line.
//
// Place on the street: between the step generator and the link. The drive above has one feed and does not know which
// kind it is.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "passo/drive/rewindable_path.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// Which items a board has executed when it rests, and where on the path that is.
struct BoardRest {
  ItemNumber executed = 0;
  PathPlace place;
  PathPlace done = {};  // the board was known to be at least here when the rest was told
  friend bool operator==(const BoardRest&, const BoardRest&) = default;
};

// How far ahead the feed commits. It adds nothing while motion of `horizon` is committed, and no move of the planner is
// longer than `longest_move`.
struct Commitment {
  Seconds horizon{0};
  Seconds longest_move{0};
  friend bool operator==(const Commitment&, const Commitment&) = default;
};

// How far ahead a drive commits when it is to react at once. An endless commitment lets the drive read ahead as far as
// the board's queue goes.
inline constexpr Commitment live_commitment{.horizon = Seconds(0.05), .longest_move = Seconds(0.005)};
inline constexpr Commitment endless_commitment{.horizon = Seconds(std::numeric_limits<double>::infinity()),
                                               .longest_move = Seconds(std::numeric_limits<double>::infinity())};

// What the current motion needs of the board.
enum class Attention : std::uint8_t {
  none,
  guards_probe,  // the probe is watched during the motion
  probes,        // a contact ends the motion: little is committed
  follows,       // the motion follows the spindle
};

class RefillLedger;

class Feed {
 public:
  enum class Progress : std::uint8_t {
    goes_on,        // something was sent, or there is more to do at once
    waits,          // the feed needs news of the board first
    rests_in_hold,  // the planner holds, and the board has executed all motion given
    at_action,      // the drive has to carry out take_action(); all before it is executed
    lost_thread,    // the board played a tail to its end in a thread, which cannot go on
    outputs_off,    // the board did not hear the host, rests, and has switched outputs off
    ended,          // the whole path is executed, or the link has an error
  };
  virtual ~Feed() = default;
  Feed() = default;
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

  virtual Progress advance() = 0;
  // True: advance() may plan more motion. False: advance() only waits for the motion already given.
  virtual bool plans() const = 0;
  virtual Action take_action() = 0;
  // The drive calls this for all motion that the planner gives.
  virtual void watch(const MotionItem& motion) = 0;
  virtual void attend(Attention attention) = 0;

  // The ordered outputs have changed in the middle of the path. The board hears of the change after the motion already
  // given.
  virtual void pass_on_outputs() = 0;
  // Switches outputs at rest, with nothing under way. settled() tells when the board has switched them.
  virtual void switch_outputs(const BoardOutputs& outputs) = 0;
  virtual bool settled() = 0;

  // How much of the given motion is, as far as the host knows, not executed.
  virtual Seconds ahead() const = 0;
  // The same for the moment `time` at which the board told where the spindle is.
  virtual Seconds ahead_of(const Turned& turned, Seconds time) = 0;
  // When the motion under way began, by the same clock. Empty where the feed cannot tell.
  virtual std::optional<Seconds> began() const = 0;
  // True: what is sent takes time to reach the board, and may come too late.
  virtual bool is_remote() const = 0;
  // Time has passed without motion.
  virtual void record_rest(Seconds time) = 0;

  // Brakes as soon as possible, after the motion that the board will play in any case.
  virtual void brake() = 0;
  // True: the board plays a tail, because nothing new has reached it, and will come to rest by itself.
  virtual bool plays_tail() const = 0;
  // At rest, after the planner has dropped the path up to the next action. Returns where the machine stands; empty:
  // where the given motion ends.
  virtual std::optional<Point> drop() = 0;
  // At rest in a hold: what was planned ahead is forgotten, and the path is read anew from where the machine stands.
  virtual void read_again() = 0;
  // Skips the rest of a dwell.
  virtual void cut_dwell() = 0;
  // The path comes to a part that follows the spindle.
  virtual void expect_thread() = 0;

  // What was sent in refills, and what the board has played of it. Null: items go to the board directly, and are played
  // as they are sent.
  virtual RefillLedger* ledger() = 0;
};

}  // namespace passo
