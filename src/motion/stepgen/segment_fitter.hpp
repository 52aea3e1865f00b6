// SegmentFitter: exact events -> one board segment that plays as many of them as possible.
//
// Time. Event k of a segment comes at k I + c k(k-1)/2, where I is the first interval and c its change. I and c are
// chosen so that this curve meets the exact times at the zeros of a Chebyshev polynomial. There a cubic error is
// smallest overall. Then each event is checked: none may be further than `exact` from its exact time. The board rounds
// to whole ticks, so the event is within one tick.
//
// Place. The master moves by the grid at each event. Any other motor adds the same increment at each event. Its step is
// due at the first event at or after the step's exact time, and may come one event early. That bounds the increment
// from both sides. If no increment keeps the bounds, the segment is shortened. Where events may be off by a whole
// interval, a step may also come one event late, except at the segment's end.
//
// About 10 ns for each event and motor.
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
  // Lets an event be off its exact time by 1/share of its interval (0: by `exact` only), and a segment have up to
  // `longest` events.
  void loosen_to(std::int64_t share, unsigned longest) {
    share_ = share;
    longest_ = longest;
  }
  unsigned longest() const { return longest_; }

  // Makes a segment of the first events of `events`, which must not be empty. Nothing is known of what follows the last
  // event. Returns the number of events in the segment. 0: the first event is too far away for one interval, so the
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
    int sign = 0;  // 0: stands still
    std::int64_t increment = 0;
    unsigned events = 0;  // the number of events that this increment serves
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
  // A motor that moves in a bend: its first increment, and what each part adds to it.
  struct Bent {
    Advance advance;
    std::int64_t change = 0;
  };
  // What a bend's changes are multiples of, and the largest of them.
  struct BendRange {
    std::int64_t unit = 1;
    std::int64_t most = 0x7fff;
  };
  // Which motors bend, and which one lends its place.
  struct Lending {
    unsigned lender = 0;
    unsigned first = 0;
    unsigned second = 0;  // the first once more: one motor bends
    unsigned most = 0;    // the number of events for which the place is free
    bool serves(unsigned motor) const { return motor == lender || motor == first || motor == second; }
  };
  // A segment's bend as the wire says it.
  struct Bending {
    std::uint8_t code = 0;  // BoardSegment::bend
    std::uint16_t lent = 0;
    unsigned k = 0;  // parts have two to the power of this many events
    unsigned lender = 0;
    unsigned events = 0;
  };
  // The first `count` of the events, in parts of two to the power `k`.
  struct BendSpan {
    const EventBuffer& events;
    const BoardModel& board;
    unsigned count = 0;
    unsigned k = 0;
  };
  // From the shortest to the longest: two to the power of these many events. None if the shortest is longer.
  struct PartRange {
    unsigned shortest = 1;
    unsigned longest = 0;
  };
  using Advances = std::array<Advance, max_motors>;

  // By how many events a step may come late within a segment.
  std::int32_t events_late() const { return share_ == 1 ? 1 : 0; }
  // Where a motor is behind by a part of a step: a segment of two events up to the first event of `events`.
  // `is_behind`: one is known to be.
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

  // The longest part of a root has two to the power of this many events.
  static constexpr unsigned longest_root_part = 7;

  std::uint8_t motors_;
  std::int64_t shortest_interval_;
  bool bends_;
  std::int64_t share_ = 0;
  unsigned longest_ = 255;
  unsigned guess_ = 255;  // the number of events in the last segment; the next number will be similar
  // The present motor's exact places in whole units, in its direction of travel, from the start of the step in which
  // the motor is. [0] is that of the first event once more.
  std::array<std::int32_t, longest_segment_of_all + 2> ideal_{};
};

// The place at which a motor rests if its exact place is `place`. The step count is the exact position, rounded to the
// nearest step; halves are rounded away from zero.
std::int64_t rest_place(double place);

// Writes an increment in the form of the wire. `sign` is 1 or -1, and `increment` is 0…65536.
void set_increment(BoardSegment& segment, unsigned motor, int sign, std::int64_t increment);

}  // namespace passo
