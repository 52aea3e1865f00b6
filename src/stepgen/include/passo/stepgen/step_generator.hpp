// StepGenerator: phases -> board segments. Each step is where and when the exact motion has it.
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

// A motor of the board, and the axis it turns.
struct Motor {
  Axis axis = Axis::x;
  double steps_per_unit = 0;  // for a millimetre or a degree; negative: the motor turns the other way
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

// The items that go down the wire, in order. The segments before an Action end at rest. A dwell has become segments
// without steps.
using BoardItem = std::variant<BoardSegment, Action>;

// How exact the times of events are. With looser times, motion takes far fewer segments close to a rest. Every step is
// still made, and at the same place.
struct Exactness {
  // An event may be off its exact time by one part in so many of its interval. 0: at most by what shows in no whole
  // tick.
  int one_in = 0;
  // Below this rate, events divide the steps of the fastest motor; on a slow board below a sixteenth of its highest
  // rate. 0: they are never divided for slowness.
  Hertz least_rate{10'000};
  // The most events of a segment. Segments that are exact to the tick seldom have more than 255.
  int longest_segment = 255;
  friend bool operator==(const Exactness&, const Exactness&) = default;
};
inline constexpr int longest_segment_of_all = 1023;

class StepGenerator final : public Source<BoardItem> {
 public:
  StepGenerator(Source<MotionItem>& motion, const StepOptions& options);
  ~StepGenerator() override;

  [[nodiscard]] bool next(BoardItem& item) override;

  // From now on events wait at most this time for later ones that would make a longer segment. So motion is pulled
  // ahead of the last segment by at most this time and a move. Segments get shorter, but no step less exact.
  void limit_waiting_to(Seconds time);
  void be_exact_to(const Exactness& exactness);

  // Continues from the state of `other`, which was made with the same options, but with its own motion, waiting time
  // and exactness. So a fork tells what another motion from here would be, and its end is a state to go on from.
  void assume(const StepGenerator& other);
  // Whether the motion pulled so far ends at rest; at_rest(): and all of it was given too.
  bool ends_at_rest() const;
  bool at_rest() const;
  // Whether the last item waits at rest and more such items may follow: a dwell.
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
