// SegmentFitter: exact events -> one board segment that plays as many of them as it can.
//
// Time. Event k of a segment comes at k I + d k(k-1)/2. I and d are chosen so that the curve meets the exact times
// where a cubic error is smallest over all (the zeros of a Chebyshev polynomial), and then each event is checked: none
// may be further than `tolerance` from its exact time. With the rounding to whole ticks that is within one tick.
//
// Place. The master moves by the grid at each event. Any other motor adds one increment d at each event; its step is
// due at the first event at or after its exact time and may come one event early. That bounds d from both sides; the
// bounds are met by shortening the segment where they must be.
//
// About 10 ns an event and motor.
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

  // How far an event may be from its exact time, in 1/65536 tick. Half a tick more comes from playing whole ticks.
  static constexpr std::int64_t exact = whole_tick * 9 / 20;
  // Instead, by so much of its interval, one part in `share`, 0: exact; and how many events a segment may have.
  void loosen_to(std::int64_t share, unsigned longest) {
    share_ = share;
    longest_ = longest;
  }
  unsigned longest() const { return longest_; }

  // Makes a segment of the first events of `events` (not empty; the last of them is followed by nothing known) and
  // returns how many it plays: 0 when the first event is too far away for one interval (wait first).
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
    unsigned events = 0;  // how many this increment serves
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
  unsigned guess_ = 255;  // how many events the last segment played: the next will be alike
  // Exact places of the motor at hand in whole units, in its direction of travel; [0] is unused.
  std::array<std::int64_t, longest_segment_of_all + 2> ideal_{};
};

// The place at which a motor rests when its exact place is `place`: the step count is the exact position rounded,
// halves away from zero.
std::int64_t rest_place(double place);

// Writes an increment of -65536…65536 in the form of the wire.
void set_increment(BoardSegment& segment, unsigned motor, int sign, std::int64_t increment);

}  // namespace passo
