// Feed: transfers board items from the step generator to the board, either directly in this process or by queue updates
// over a link.
//
// Position in the pipeline: between the step generator and the link. The drive above has one feed and does not know
// which kind it is.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "passo/drive/rewindable_path.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// The items that a board has executed at a stop, and the corresponding position on the path.
struct BoardStop {
  ItemNumber executed = 0;
  PathPosition place;
  PathPosition done = {};  // the item up to which the board was known to be done when the stop was reported
  friend bool operator==(const BoardStop&, const BoardStop&) = default;
};

// The commitment of the feed: it adds nothing while motion of `horizon` is committed, and no planned move is longer
// than `longest_move`.
struct Commitment {
  Seconds horizon{0};
  Seconds longest_move{0};
  friend bool operator==(const Commitment&, const Commitment&) = default;
};

// The commitment for a drive that must react quickly. An endless commitment lets the drive read ahead as far as the
// board's queue allows.
inline constexpr Commitment live_commitment{.horizon = Seconds(0.05), .longest_move = Seconds(0.005)};
inline constexpr Commitment endless_commitment{.horizon = Seconds(std::numeric_limits<double>::infinity()),
                                               .longest_move = Seconds(std::numeric_limits<double>::infinity())};

// The requirements of the current motion on the board.
enum class Attention : std::uint8_t {
  none,
  guards_probe,  // the probe is watched during the motion
  probes,        // a contact ends the motion: little is committed
  follows,       // the motion follows the spindle
};

class QueueUpdateLedger;

class Feed {
 public:
  enum class Progress : std::uint8_t {
    goes_on,        // something was sent, or more can be done at once
    waits,          // the feed first needs a message from the board
    rests_in_hold,  // the planner holds, and the board has executed all planned motion
    at_action,      // the drive has to perform take_action(); everything before it is executed
    lost_thread,    // the board executed a stop ramp in a thread, which cannot continue
    outputs_off,    // the board received nothing from the host, is stopped, and has switched outputs off
    ended,          // the whole path is executed, or the link has an error
  };
  virtual ~Feed() = default;
  Feed() = default;
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

  virtual Progress advance() = 0;
  // Returns true if advance() may plan more motion. Returns false if advance() only waits for the motion already
  // planned.
  virtual bool plans() const = 0;
  virtual Action take_action() = 0;
  // The drive calls this for all planned motion.
  virtual void watch(const MotionItem& motion) = 0;
  virtual void attend(Attention attention) = 0;

  // The commanded outputs have changed in the middle of the path. The board receives the change after the motion
  // already planned.
  virtual void pass_on_outputs() = 0;
  // Switches outputs while stopped, with nothing unexecuted. settled() shows when the board has switched them.
  virtual void switch_outputs(const BoardOutputs& outputs) = 0;
  virtual bool settled() = 0;

  // The time of the planned motion that, as far as the host knows, is not executed.
  virtual Seconds ahead() const = 0;
  // The same for the time at which the board reported the spindle's angle.
  virtual Seconds ahead_of(const Turned& turned, Seconds time) = 0;
  // The start time of the current motion, by the same clock. Empty if the feed does not know it.
  virtual std::optional<Seconds> began() const = 0;
  // Returns true if a message takes time to reach the board, and may come too late.
  virtual bool is_remote() const = 0;
  // Records time that passed without motion.
  virtual void record_rest(Seconds time) = 0;

  // Decelerates as soon as possible, after the motion that the board will execute in any case.
  virtual void brake() = 0;
  // Returns true if the board executes a stop ramp, because no queue update has reached it, and will stop by itself.
  virtual bool plays_tail() const = 0;
  // Call at standstill, after the planner has dropped the path up to the next action. Returns the machine position;
  // empty: the end of the planned motion.
  virtual std::optional<Point> drop() = 0;
  // While stopped in a hold: drops the motion planned ahead, and reads the path again from the current position.
  virtual void read_again() = 0;
  // Skips the remaining time of a dwell.
  virtual void cut_dwell() = 0;
  // Announces that the path reaches a part that follows the spindle.
  virtual void expect_thread() = 0;

  // Returns the items sent in queue updates, and those of them that the board has executed. Returns null if items go to
  // the board directly, and are executed as they are sent.
  virtual QueueUpdateLedger* ledger() = 0;
};

}  // namespace passo
