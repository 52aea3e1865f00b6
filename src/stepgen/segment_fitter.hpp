// SegmentFitter: exact events -> one board segment that plays as many of them as possible.
//
// Time. Event k of a segment comes at k I + d k(k-1)/2. I and d are chosen so that this curve meets the exact times at
// the zeros of a Chebyshev polynomial, where a cubic error is smallest overall. Then each event is checked: none may be
// further than `tolerance` from its exact time. With the rounding to whole ticks that is within one tick.
//
// Place. The master moves by the grid at each event. Any other motor adds one increment d at each event. Its step is
// due at the first event at or after its exact time, and may come one event early. That bounds d from both sides; where
// no d keeps the bounds, the segment is shortened.
//
// About 10 ns for each event and motor.
#pragma once

#include <array>
#include <cstdint>

#include "board_model.hpp"
#include "event_buffer.hpp"

#include "passo/stepgen/step_generator.hpp"

namespace passo {

class SegmentFitter {
 public:
  SegmentFitter(std::uint8_t motors, std::int64_t shortest_interval)
      : motors_(motors), shortest_interval_(shortest_interval) {}

  // The greatest distance of an event from its exact time, in 1/65536 tick. Playing whole ticks adds half a tick.
  static constexpr std::int64_t exact = whole_tick * 9 / 20;
  // Allows instead one part in `share` of an event's interval (0: exact), and segments of up to `longest` events.
  void loosen_to(std::int64_t share, unsigned longest) {
    share_ = share;
    longest_ = longest;
  }
  unsigned longest() const { return longest_; }

  // Makes a segment of the first events of `events`, which must not be empty; nothing is known of what follows its last
  // event. Returns the number of events played. 0 means that the first event is too far away for one interval: wait
  // first.
  unsigned fit(const EventBuffer& events, const Stretch& stretch, const BoardModel& board, BoardSegment& segment);

 private:
  struct Timing {
    std::uint32_t interval = 0;
    std::int32_t change = 0;
    unsigned events = 0;
  };
  struct Advance {
    int sign = 0;  // 0: stands still
    std::int64_t increment = 0;
    unsigned events = 0;  // the number that this increment serves
  };

  Timing fit_time(const EventBuffer& events, std::int64_t now, unsigned most);
  bool times_hold(const EventBuffer& events, std::int64_t now, const Timing& timing) const;
  Advance advance_master(const Stretch& stretch, std::int64_t position, double first_target, unsigned events) const;
  Advance advance_other(const EventBuffer& events, unsigned motor, std::int64_t position, unsigned count);
  Advance settle(std::int64_t position, double place, unsigned count) const;
  Advance within_bounds(std::int64_t place, unsigned count) const;

  std::uint8_t motors_;
  std::int64_t shortest_interval_;
  std::int64_t share_ = 0;
  unsigned longest_ = 255;
  unsigned guess_ = 255;  // the events of the last segment: the next one will be similar
  // The present motor's exact places in whole units, in its direction of travel. [0] is unused.
  std::array<std::int64_t, longest_segment_of_all + 2> ideal_{};
};

// The place at which a motor rests if its exact place is `place`: the step count is the exact position rounded, halves
// away from zero.
std::int64_t rest_place(double place);

// Writes an increment of -65536…65536 in the form of the wire.
void set_increment(BoardSegment& segment, unsigned motor, int sign, std::int64_t increment);

}  // namespace passo
