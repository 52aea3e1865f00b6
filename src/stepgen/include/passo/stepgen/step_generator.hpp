// StepGenerator: phases -> board segments. Every step where and when mathematics puts it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "passo/base/source.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// A motor of the board and the axis it turns.
struct Motor {
  Axis axis = Axis::x;
  double steps_per_unit = 0;  // a millimetre or a degree; negative: the motor turns the other way
};

struct BoardClock {
  Hertz tick_rate{16e6};
  Hertz highest_event_rate{100e3};
};

// Where the board stands, to the last bit, so that the next path begins with what the last one has left: each motor in
// 1/65536 step with half a step added, and the fraction of a tick.
struct BoardPlace {
  std::array<std::int64_t, max_motors> motors{};
  std::uint16_t tick = whole_tick / 2;
  std::int64_t steps(std::size_t motor) const { return motors[motor] >> 16; }
  // The motor is said to stand at another whole step.
  void set_steps(std::size_t motor, std::int64_t steps) {
    motors[motor] = steps * whole_step + (motors[motor] & (whole_step - 1));
  }
  friend bool operator==(const BoardPlace&, const BoardPlace&) = default;
};

struct StepOptions {
  std::array<Motor, max_motors> motors;
  std::uint8_t motor_count = 0;
  BoardClock clock;
  Point start;  // machine position at the start; the motors' step counts begin at its whole steps
  std::optional<BoardPlace> place = {};  // where the board stands; nothing: it has just heard a hello, at `start`
};

// What goes down the wire, in order. An Action follows the segments that end at rest before it; a dwell has become
// segments without steps.
using BoardItem = std::variant<BoardSegment, Action>;

// How exact the times of events are. Looser, motion takes far fewer segments close to a rest; no step less, and none in
// another place.
struct Exactness {
  // An event may be off its exact time by this part of its interval; 0: only as far as it shows in no whole tick.
  int one_in = 0;
  // Where events would come more seldom they divide the steps of the fastest motor, on a slow board from a sixteenth of
  // its highest rate on. 0: they never divide more finely than they do.
  Hertz least_rate{10'000};
  // Events of a segment. So many as are exact to the tick are seldom more than 255.
  int longest_segment = 255;
  friend bool operator==(const Exactness&, const Exactness&) = default;
};
inline constexpr int longest_segment_of_all = 1023;

class StepGenerator final : public Source<BoardItem> {
 public:
  StepGenerator(Source<MotionItem>& motion, const StepOptions& options);
  ~StepGenerator() override;

  [[nodiscard]] bool next(BoardItem& item) override;

  // From now on events wait no longer than this for later ones that would make a longer board segment: what motion is
  // pulled ahead of the segment given is at most this and a move. Segments get shorter, no step less exact.
  void limit_waiting_to(Seconds time);
  void be_exact_to(const Exactness& exactness);

  // From now on goes on as `other` would, which was made with the same options, but with its own motion, waiting and
  // exactness. So a fork tells what another motion from here on would be, and its end is a place to go on from.
  void assume(const StepGenerator& other);
  // All the motion that was pulled ends at rest; and it is given, too.
  bool ends_at_rest() const;
  bool at_rest() const;
  // What was given last is waiting at rest, of which there may be more: a dwell.
  bool waits_at_rest() const;
  // The rest of that waiting is left out. How long it was.
  Seconds cut_dwell();
  // At rest, after all that was given.
  BoardPlace place() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
