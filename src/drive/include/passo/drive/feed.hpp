// Feed: how board items get from the step generator to the board. Directly, in this process, or by refills over a line.
//
// Place on the street: between the step generator and the link. The drive above knows one feed and not which it is.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/drive/rewindable_path.hpp"
#include "passo/link/link.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// What a board has done when it rests, and where on the path that is.
struct BoardRest {
  ItemNumber executed = 0;
  PathPlace place;
  friend bool operator==(const BoardRest&, const BoardRest&) = default;
};

// How far ahead is committed: nothing is added while as much is, and the planner's moves end after this time.
struct Commitment {
  Seconds horizon{0};
  Seconds longest_move{0};
  friend bool operator==(const Commitment&, const Commitment&) = default;
};

// What the motion at hand needs of the board.
enum class Attention : std::uint8_t {
  none,
  guards_probe,  // the probe is watched besides
  probes,        // a contact ends the motion: little is committed
  follows,       // the motion follows the spindle
};

class Feed {
 public:
  enum class Turn : std::uint8_t {
    goes_on,        // something was sent, or there is more to do at once
    waits,          // for news of the board
    rests_in_hold,  // the planner holds, and all that was given is executed
    at_action,      // one that is the drive's to do, with all before it executed: take_action()
    lost_thread,    // a tail was played to its end in a thread: nothing goes on there
    ended,          // all of the path is executed, or the link has an error
  };
  virtual ~Feed() = default;
  Feed() = default;
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;

  virtual Turn advance() = 0;
  // advance() may plan more motion. False: what was given is only waited for.
  virtual bool plans() const = 0;
  virtual Action take_action() = 0;
  // To be told of all motion that the planner gives.
  virtual void watch(const MotionItem& motion) = 0;
  virtual void attend(Attention attention) = 0;

  // The order for the outputs has changed amid the path: the board hears of it after what was given.
  virtual void pass_on_outputs() = 0;
  // At rest, with nothing under way: outputs by themselves. settled() tells that they are switched.
  virtual void switch_outputs(const BoardOutputs& outputs) = 0;
  virtual bool settled() = 0;

  // The motion that was given and is, as far as the host knows, not executed.
  virtual Seconds ahead() const = 0;
  // The same, as it was when the board told where the spindle is, `time` then.
  virtual Seconds ahead_of(const Turned& turned, Seconds time) = 0;
  // When, by the same clock, the motion began that is under way; nothing where the feed cannot tell.
  virtual std::optional<Seconds> began() const = 0;
  // What is sent takes time to the board, and may come too late.
  virtual bool is_remote() const = 0;
  // Time has passed that was no motion.
  virtual void note_rest(Seconds time) = 0;

  // Brakes as soon as can be, behind what the board holds in any case.
  virtual void brake() = 0;
  // What the board plays now ends at rest by itself, since nothing new has reached it.
  virtual bool plays_tail() const = 0;
  // At rest, the planner having dropped the path up to the next action: where the machine stands. Nothing: where the
  // motion that was given ends.
  virtual std::optional<Point> drop() = 0;
  // The rest of a dwell is not waited for.
  virtual void cut_dwell() = 0;
};

}  // namespace passo
