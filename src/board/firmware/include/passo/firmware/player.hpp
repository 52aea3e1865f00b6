// Player: plays board segments event by event. The host simulates motion with the same code.
//
// Invariant: accumulators and the fraction of a tick continue from segment to segment; nothing is rounded in between.
// Portable: integers only, no division, no heap. On the host about 3 ns per event.
#pragma once

#include "passo/wire/board_segment.hpp"

namespace passo {

class Player {
 public:
  explicit Player(uint8_t motors) : motors_(motors) {}

  // Whether it can accept the next item.
  bool ready() const { return done(); }
  // Loads the next segment, of 255 events at most. Call only when ready().
  template <uint8_t room>
  void load(const SegmentFor<room>& segment) {
    segment_.events = segment.events;
    segment_.directions = segment.directions;
    segment_.flips = segment.flips;
    segment_.interval = segment.interval;
    segment_.change = segment.change;
    for (uint8_t motor = 0; motor < motors_; ++motor) segment_.increments[motor] = segment.increments[motor];
    left_ = static_cast<uint8_t>(segment.events);
    for (uint8_t motor = 0; motor < motors_; ++motor) at_start_[motor] = accumulators_[motor];
  }
  // Accepts an item that another part executes. It is finished when all items before it are. Call only when ready().
  void pass(const BoardOutputs& /*outputs*/) { ++finished_; }
  // Whether the oldest item is done: played() and steps() are then final. Call forget() afterwards.
  bool finished() const { return finished_ != 0; }
  void forget() { --finished_; }
  // Resets the player to its initial state, and interrupts playback.
  void restart(uint8_t motors) { *this = Player(motors); }

  bool done() const { return left_ == 0; }
  // Whether an event since restart() was late, which also delays all later ones. Here each event is made when it is
  // due, unless slip() is called.
  bool slipped() const { return slipped_; }
  void slip() { slipped_ = true; }
  uint8_t directions() const { return segment_.directions; }

  // Returns the whole ticks from the last event to the next. Call once for each event, only when not done().
  uint32_t wait() {
    const uint32_t fraction = tick_fraction_ + (segment_.interval & 0xffff);
    tick_fraction_ = static_cast<uint16_t>(fraction);
    const uint32_t ticks = (segment_.interval >> 16) + (fraction >> 16);
    segment_.interval += static_cast<uint32_t>(segment_.change);
    return ticks;
  }

  // Plays the event. Bit m of the result: motor m steps, in the direction of directions().
  uint8_t play() {
    uint8_t carries = 0;
    for (uint8_t motor = 0; motor < motors_; ++motor) {
      const uint16_t before = accumulators_[motor];
      const uint16_t after = static_cast<uint16_t>(before + segment_.increments[motor]);
      accumulators_[motor] = after;
      if (after < before) carries = static_cast<uint8_t>(carries | 1U << motor);
    }
    if (--left_ == 0) ++finished_;
    return carries ^ segment_.flips;
  }

  // For the present segment: the events played, and the signed number of steps of a motor in them.
  uint8_t played() const { return static_cast<uint8_t>(segment_.events - left_); }
  int16_t steps(uint8_t motor) const {
    // Steps are not counted at each event: the number of carries follows from the number of increments.
    const uint8_t bit = static_cast<uint8_t>(1U << motor);
    const uint32_t added = at_start_[motor] + static_cast<uint32_t>(segment_.increments[motor]) * played();
    const int16_t carries = static_cast<int16_t>(added >> 16);
    const int16_t steps = (segment_.flips & bit) != 0 ? static_cast<int16_t>(played() - carries) : carries;
    return (segment_.directions & bit) != 0 ? static_cast<int16_t>(-steps) : steps;
  }

  // Adds the steps of all motors to their positions. Call once for each segment, when it has ended or is interrupted.
  void add_steps(int32_t* positions) const {
    for (uint8_t motor = 0; motor < motors_; ++motor) positions[motor] += steps(motor);
  }

  uint16_t accumulator(uint8_t motor) const { return accumulators_[motor]; }
  uint16_t tick_fraction() const { return tick_fraction_; }

 private:
  BoardSegment segment_;
  uint8_t motors_;
  uint8_t left_ = 0;
  uint8_t finished_ = 0;  // items done and not dropped yet
  bool slipped_ = false;
  // Start values of half a step and half a tick, so that truncation to whole steps and ticks rounds to nearest.
  uint16_t accumulators_[max_motors] = {0x8000, 0x8000, 0x8000, 0x8000, 0x8000, 0x8000, 0x8000, 0x8000};
  uint16_t at_start_[max_motors] = {};  // as they were at the start of the segment
  uint16_t tick_fraction_ = 0x8000;
};

}  // namespace passo
