// BoardModel: the host's bit-exact copy of the board's state: each motor's fixed-point position and the board's time.
//
// The board's Player plays a segment event by event. BoardModel computes one sum for each motor and one for the time.
// This takes a tenth of the time needed to make the segment. A test compares BoardModel with Player.
#pragma once

#include <array>
#include <cstdint>

#include "passo/stepgen/step_generator.hpp"
#include "passo/wire/board_segment.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo {

class BoardModel {
 public:
  explicit BoardModel(std::uint8_t motors) : motors_(motors) { position_.fill(whole_step / 2); }

  // The time is in 1/65536 tick with half a tick added, a position in 1/65536 step with half a step added.
  std::int64_t time() const { return time_; }
  std::int64_t position(unsigned motor) const { return position_[motor]; }
  void set_steps(unsigned motor, std::int64_t steps) {
    position_[motor] = steps * whole_step + (position_[motor] & (whole_step - 1));
  }

  void set_place(const BoardPosition& place) {
    time_ = place.tick;
    position_ = place.motors;
  }
  BoardPosition place() const { return {.motors = position_, .tick = static_cast<std::uint16_t>(time_)}; }

  void play(const BoardSegment& segment) {
    time_ += duration(segment, most_events);
    if (segment.bend == 0) return move(segment);
    for_each_plain_part(segment, [this](const BoardSegment& part) { move(part); });
  }

 private:
  void move(const BoardSegment& segment) {
    const std::int64_t events = segment.events;
    for (unsigned m = 0; m < motors_; ++m) {
      const bool down = (segment.directions >> m & 1U) != 0;
      const bool flipped = (segment.flips >> m & 1U) != 0;
      const std::int64_t reached = (position_[m] & (whole_step - 1)) + events * segment.increments[m];
      const std::int64_t carries = reached >> 16;
      const std::int64_t steps = flipped ? events - carries : carries;
      position_[m] = ((position_[m] >> 16) + (down ? -steps : steps)) * whole_step + (reached & (whole_step - 1));
    }
  }

  std::uint8_t motors_;
  std::int64_t time_ = whole_tick / 2;
  std::array<std::int64_t, max_motors> position_{};
};

}  // namespace passo
