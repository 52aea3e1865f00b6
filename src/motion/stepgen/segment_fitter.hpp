// SegmentFitter: converts as many exact events as possible into one board segment.
//
// Time. Event k of a segment comes at k I + c k(k-1)/2, where I is the first interval and c its change. I and c are
// chosen so that this curve meets the exact times at the zeros of a Chebyshev polynomial, which minimises a cubic
// error. Then each event is checked: none may be further than `exact` from its exact time. The board rounds to whole
// ticks, so the event is within one tick.
//
// Position. The master moves by the grid at each event. Any other motor adds the same increment at each event. Its step
// is due at the first event at or after the step's exact time, and may come one event early. This limits the increment
// from both sides. If no increment is within the limits, the segment is shortened. Where events may be off by a whole
// interval, a step may also come one event late, except at the segment's end.
//
// About 10 ns per event and motor.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "board_model.hpp"
#include "event_buffer.hpp"

#include "passo/stepgen/step_generator.hpp"

namespace passo {

class SegmentFitter {
 public:
  SegmentFitter(std::uint8_t motors, std::int64_t shortest_interval, bool bends)
      : motors_(motors), shortest_interval_(shortest_interval), bends_(bends) {}

  // The greatest distance of an event from its exact time, in 1/65536 tick. Rounding to whole ticks adds half a tick.
  static constexpr std::int64_t exact = whole_tick * 9 / 20;
  // Allows an event to be off its exact time by 1/share of its interval (0: by `exact` only), and a segment to have up
  // to `longest` events.
  void loosen_to(std::int64_t share, unsigned longest) {
    share_ = share;
    longest_ = longest;
  }
  unsigned longest() const { return longest_; }

  // Makes a segment of the first events of `events`, which must not be empty. Nothing is assumed about events after the
  // last one. Returns the number of events in the segment. 0: the first event is too far away for one interval, so the
  // caller must wait first.
  unsigned fit(const EventBuffer& events, const Stretch& stretch, const BoardModel& board, BoardSegment& segment);

 private:
  struct Timing {
    std::uint32_t interval = 0;
    std::int32_t change = 0;
    unsigned events = 0;
    std::uint8_t form = 0;
  };
  struct Advance {
    int sign = 0;  // 0: does not move
    std::int64_t increment = 0;
    unsigned events = 0;  // the number of events for which this increment is valid
  };

  Timing fit_time(const EventBuffer& events, std::int64_t now, unsigned most);
  Timing fit_quadratic(const EventBuffer& events, std::int64_t now, unsigned most);
  Timing fit_late(const EventBuffer& events, std::int64_t now, unsigned most) const;
  Timing fit_root(const EventBuffer& events, std::int64_t now, unsigned most, unsigned least) const;
  double least_events_of_part(double interval) const;
  bool root_holds(const EventBuffer& events, std::int64_t now, const Timing& root) const;
  std::optional<Timing> root_of(const EventBuffer& events, std::int64_t now, unsigned n) const;
  bool times_hold(const EventBuffer& events, std::int64_t now, const Timing& timing) const;
  bool part_holds(const EventBuffer& events, std::int64_t now, const Timing& timing, unsigned first) const;
  // A motor with a bend: its first increment, and the change of the increment per part.
  struct Bent {
    Advance advance;
    std::int64_t change = 0;
  };
  // The unit of a bend's changes, and the largest change.
  struct BendRange {
    std::int64_t unit = 1;
    std::int64_t most = 0x7fff;
  };
  // The motors with a bend, and the motor that lends its field.
  struct Lending {
    unsigned lender = 0;
    unsigned first = 0;
    unsigned second = 0;  // equal to the first: only one motor has a bend
    unsigned most = 0;    // the number of events for which the lender's field is free
    bool serves(unsigned motor) const { return motor == lender || motor == first || motor == second; }
  };
  // A segment's bend in the format of the wire protocol.
  struct Bending {
    std::uint8_t code = 0;  // BoardSegment::bend
    std::uint16_t lent = 0;
    unsigned k = 0;  // each part has 2^k events
    unsigned lender = 0;
    unsigned events = 0;
  };
  // The first `count` events, in parts of 2^k events.
  struct BendSpan {
    const EventBuffer& events;
    const BoardModel& board;
    unsigned count = 0;
    unsigned k = 0;
  };
  // The shortest and the longest part length, as powers of two. Empty if the shortest is longer than the longest.
  struct PartRange {
    unsigned shortest = 1;
    unsigned longest = 0;
  };
  using Advances = std::array<Advance, max_motors>;

  // The number of events by which a step may come late within a segment.
  std::int32_t events_late() const { return share_ == 1 ? 1 : 0; }
  // For a motor that is behind by a fraction of a step: makes a segment of two events up to the first event of
  // `events`. `is_behind`: at least one motor is known to be behind.
  bool catch_up(const EventBuffer& events, const Stretch& stretch, const BoardModel& board, bool is_behind,
                BoardSegment& segment) const;
  void write(const Advances& advances, std::uint8_t kept_directions, BoardSegment& segment) const;
  std::optional<Bending> fit_bend(const EventBuffer& events, const Stretch& stretch, const BoardModel& board,
                                  const Timing& timing, Advances& advances);
  std::optional<Lending> find_lender(const EventBuffer& events, const Stretch& stretch, const BoardModel& board,
                                     const Advances& advances, unsigned bent, unsigned count) const;
  PartRange parts_of(const Timing& timing) const;
  std::optional<Bending> bend_by(const Lending& lending, BendSpan span, PartRange parts, unsigned master,
                                 Advances& advances);
  std::optional<Bending> bend_one(const BendSpan& span, const Lending& lending, Advances& advances);
  std::optional<Bending> bend_two(const BendSpan& span, const Lending& lending, Advances& advances);
  unsigned count_without_step(const EventBuffer& events, unsigned motor, std::int64_t position, unsigned count) const;
  std::optional<Bent> bend_of(const BendSpan& span, unsigned motor, BendRange range);
  Advance advance_master(const Stretch& stretch, std::int64_t position, double first_target, unsigned events) const;
  Advance advance_other(const EventBuffer& events, unsigned motor, std::int64_t position, unsigned count);
  static std::size_t first_move(const EventBuffer& events, unsigned motor, unsigned count);
  unsigned count_until_turn(const EventBuffer& events, unsigned motor, std::size_t first, int sign,
                            unsigned count) const;
  void find_due(const EventBuffer& events, unsigned motor, int sign, std::int64_t this_step, unsigned count);
  Advance settle(std::int64_t position, double place, unsigned count) const;
  Advance within_bounds(std::int32_t place, std::int32_t count) const;

  // The longest part of a root segment has two to the power of this many events.
  static constexpr unsigned longest_root_part = 7;

  std::uint8_t motors_;
  std::int64_t shortest_interval_;
  bool bends_;
  std::int64_t share_ = 0;
  unsigned longest_ = 255;
  unsigned guess_ = 255;  // the number of events in the last segment; the next number will be similar
  // The current motor's exact positions in whole units, in its direction of travel, from the start of the motor's
  // current step. [0] repeats that of the first event.
  std::array<std::int32_t, longest_segment_of_all + 2> ideal_{};
};

// Returns the position at which a motor stops if its exact position is `place`. The step count is the exact position,
// rounded to the nearest step; halves are rounded away from zero.
std::int64_t rest_place(double place);

// Writes an increment in the format of the wire protocol. `sign` is 1 or -1, and `increment` is 0…65536.
void set_increment(BoardSegment& segment, unsigned motor, int sign, std::int64_t increment);

}  // namespace passo
