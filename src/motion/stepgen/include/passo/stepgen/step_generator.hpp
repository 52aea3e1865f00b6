// StepGenerator: converts phases into board segments. Each step has the position and the time that it has in the exact
// motion.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "passo/base/source.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

struct BoardClock {
  Hertz tick_rate{16e6};
  Hertz highest_event_rate{100e3};
};

// The exact position of the board: each motor in 1/65536 step, with half a step added, and the fraction of a tick. The
// next path begins with these fractions.
struct BoardPosition {
  std::array<std::int64_t, max_motors> motors{};
  std::uint16_t tick = whole_tick / 2;
  std::int64_t steps(std::size_t motor) const { return motors[motor] >> 16; }
  // Changes the motor's whole step count. The fraction of a step is kept.
  void set_steps(std::size_t motor, std::int64_t steps) {
    motors[motor] = steps * whole_step + (motors[motor] & (whole_step - 1));
  }
  // Returns the position with fractions.
  MotorPosition exact() const {
    MotorPosition place;
    for (std::size_t m = 0; m < motors.size(); ++m) place[m] = static_cast<double>(motors[m]) / whole_step - 0.5;
    return place;
  }
  friend bool operator==(const BoardPosition&, const BoardPosition&) = default;
};

struct StepOptions {
  Kinematics kinematics = {};
  BoardClock clock;
  Point start = {};   // machine position at the start; the motors' step counts begin at its whole steps
  bool bends = true;  // whether segments may have a bend, which does not suit the second motor of an axis
  std::optional<BoardPosition> place =
      {};              // the board's position; empty: the handshake has just taken place at `start`
  AxisSet downs = {};  // the axes whose backlash is taken up for motion in the negative direction
};

// The items that are sent to the board, in order. The segments before an Action end in a stop. A dwell becomes segments
// without steps. PathOutputs come where they change: after the last event before their position on the path.
using BoardItem = std::variant<BoardSegment, Action, PathOutputs>;

// The accuracy of event times. With less accurate times, motion close to a stop point needs far fewer segments. Every
// step is still made, at the same position.
struct Exactness {
  // An event may be off its exact time by 1/one_in of its interval. 0: an event may be off by less than half a tick,
  // before the board rounds to whole ticks.
  int one_in = 0;
  // If the fastest motor steps slower than this rate, events divide its steps. On a slow board, the limit is a
  // sixteenth of the board's highest rate. 0: slow steps are never divided.
  Hertz least_rate{10'000};
  // The most events of a segment. Segments that are exact to the tick rarely have more than 255.
  int longest_segment = 255;
  // Whether motion that ends in a stop ends at its exact time. If not, it ends with the last step.
  bool ends_in_time = true;
  // Where a laser's power follows the speed: the number of its values from standstill to the programmed speed.
  int power_levels = 32;
  friend bool operator==(const Exactness&, const Exactness&) = default;
};
inline constexpr int longest_segment_of_all = 2047;
// Below this event rate the steps of the fastest motor are divided, unless another exactness was requested: this
// fraction of the board's highest rate, or Exactness::least_rate if that is lower.
inline constexpr double slow_share = 1.0 / 16;
inline Hertz slow_event_rate(Hertz highest_event_rate) {
  return std::min(Exactness{}.least_rate, highest_event_rate * slow_share);
}

class StepGenerator final : public Source<BoardItem> {
 public:
  StepGenerator(Source<MotionItem>& motion, const StepOptions& options);
  ~StepGenerator() override;

  [[nodiscard]] bool next(BoardItem& item) override;

  // Limits the time that an event waits for later events in the same segment. Motion is then pulled ahead by at most
  // this time and one move. Segments get shorter, but steps stay equally accurate.
  void limit_waiting_to(Seconds time);
  void be_exact_to(const Exactness& exactness);

  // Takes over the state of `other`, but keeps its own source of motion, waiting time and exactness. `other` must have
  // been made with the same options. A copy can thus try another motion from here, and motion can continue from the
  // copy's end state.
  void assume(const StepGenerator& other);
  // Whether the motion pulled so far ends in a stop.
  bool ends_at_rest() const;
  // Whether the motion pulled so far ends in a stop, and next() has returned all of it.
  bool at_rest() const;
  // Whether the last item was a part of a dwell, and more of the dwell may follow.
  bool waits_at_rest() const;
  // Skips the remainder of the present dwell. Returns its duration.
  Seconds cut_dwell();
  // The board's position after all items returned so far. Call it only at a stop.
  BoardPosition place() const;
  // The axes whose backlash is taken up for motion in the negative direction, at the end of the motion pulled so far.
  AxisSet downs() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
