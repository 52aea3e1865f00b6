// BoardModel: the board as the host knows it. Plays the board's own code on every segment that is sent, so that the
// host knows each motor's fixed-point place and the board's time to the last bit.
#pragma once

#include <array>
#include <cstdint>

#include "passo/firmware/player.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

class BoardModel {
 public:
  explicit BoardModel(std::uint8_t motors) : player_(motors), motors_(motors) {
    for (unsigned m = 0; m < motors; ++m) position_[m] = player_.accumulator(static_cast<std::uint8_t>(m));
    time_ = player_.tick_fraction();
  }

  // In 1/65536 tick, half a tick added; in 1/65536 step, half a step added.
  std::int64_t time() const { return time_; }
  std::int64_t position(unsigned motor) const { return position_[motor]; }
  void set_steps(unsigned motor, std::int64_t steps) {
    position_[motor] = steps * whole_step + player_.accumulator(static_cast<std::uint8_t>(motor));
  }

  void play(const BoardSegment& segment) {
    std::int64_t ticks = time_ >> 16;
    std::array<std::int64_t, max_motors> steps{};
    player_.load(segment);
    while (!player_.done()) {
      ticks += player_.wait();
      const unsigned stepped = player_.play();
      for (unsigned m = 0; m < motors_; ++m) steps[m] += stepped >> m & 1U;
    }
    time_ = (ticks << 16) + player_.tick_fraction();
    for (unsigned m = 0; m < motors_; ++m) {
      const bool down = (segment.directions >> m & 1U) != 0;
      const std::int64_t whole = (position_[m] >> 16) + (down ? -steps[m] : steps[m]);
      position_[m] = whole * whole_step + player_.accumulator(static_cast<std::uint8_t>(m));
    }
  }

 private:
  Player player_;
  std::uint8_t motors_;
  std::int64_t time_ = 0;
  std::array<std::int64_t, max_motors> position_{};
};

}  // namespace passo
