#include "segment_fitter.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace passo {
namespace {

// An interval must fit the board's timer.
constexpr std::int64_t longest_interval = 65535 * whole_tick;
// The places where the error of the fit is zero, as shares of the segment. They are the zeros of the Chebyshev
// polynomial T3, moved so that the first zero is at the start.
constexpr double first_node = 0.464;
constexpr double second_node = 0.928;
// A motor that moves less than this in one event stands still. In 1/65536 step.
constexpr double still = 1e-4;

std::int64_t floor_to_int(double x) {
  const auto truncated = static_cast<std::int64_t>(x);
  return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}
// The same for |x| below 2^30, to within 2^-22: a shift makes all numbers positive, which are rounded down where their
// fraction is cut. The compiler makes vectors of this, and not of a comparison.
std::int32_t floor_to_int_32(double x) {
  constexpr std::int32_t shift = 1 << 30;
  return static_cast<std::int32_t>(x + shift) - shift;
}
// A place within one segment, in 1/65536 step from the start of the step in which the motor is. The steps of a segment
// fit 32 bits, and the processor computes twice as many of these at once.
std::int32_t step_of(std::int32_t place) {
  return place >> 16;
}
// Halves away from zero.
std::int64_t nearest(double x) {
  return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
}
template <typename Int>
Int ceil_divide(Int a, Int b) {
  return a >= 0 ? (a + b - 1) / b : -(-a / b);
}
template <typename Int>
Int floor_divide(Int a, Int b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

// The place in the direction of travel. For a motor that goes down, the complement mirrors the place: what is left of a
// step becomes what is done of the step.
std::int64_t along(int sign, std::int64_t position) {
  return sign > 0 ? position : ~position;
}

}  // namespace

std::int64_t rest_place(double place) {
  const std::int64_t steps = nearest(place / 65536.0 - 0.5);
  return std::clamp(floor_to_int(place), steps * whole_step, steps * whole_step + whole_step - 1);
}

void set_increment(BoardSegment& segment, unsigned motor, int sign, std::int64_t increment) {
  assert(increment >= 0 && increment <= whole_step);
  const unsigned bit = 1U << motor;
  if (sign < 0) {
    segment.directions = static_cast<std::uint8_t>(segment.directions | bit);
    if (increment > 0) segment.flips = static_cast<std::uint8_t>(segment.flips | bit);
    segment.increments[motor] = static_cast<std::uint16_t>(whole_step - increment);
  } else {
    if (increment == whole_step) segment.flips = static_cast<std::uint8_t>(segment.flips | bit);
    segment.increments[motor] = static_cast<std::uint16_t>(increment);
  }
}

bool SegmentFitter::times_hold(const EventBuffer& events, std::int64_t now, const Timing& timing) const {
  // Most fits that fail do so at the last event: a look there spares the others.
  const std::int64_t n = timing.events;
  const std::int64_t end = now + n * timing.interval + timing.change * (n * (n - 1) / 2);
  if (share_ == 0 && std::abs(end - events.time(timing.events - 1)) > exact) return false;
  std::int64_t interval = timing.interval;
  std::int64_t time = now;
  for (unsigned k = 0; k < timing.events; ++k) {
    time += interval;
    const std::int64_t off = std::abs(time - events.time(k));
    if (off > exact && (share_ == 0 || off > interval / share_)) return false;
    interval += timing.change;
  }
  const std::int64_t last = interval - timing.change;
  const std::int64_t shortest = shortest_interval_ - whole_tick;
  return std::min<std::int64_t>(timing.interval, last) >= shortest &&
         std::max<std::int64_t>(timing.interval, last) <= longest_interval;
}

SegmentFitter::Timing SegmentFitter::fit_time(const EventBuffer& events, std::int64_t now, unsigned most) {
  // A segment of one event always meets the event exactly, unless the event is too near or too far.
  const std::int64_t first = events.time(0) - now;
  if (first > longest_interval) return {};
  const Timing single{.interval = static_cast<std::uint32_t>(std::max(first, shortest_interval_)), .events = 1};

  unsigned n = std::min(most, guess_ + guess_ / 4 + 4);
  for (; n > 1; n = std::min(n - 1, n * 3 / 4)) {
    const unsigned m1 = std::max(1U, static_cast<unsigned>(first_node * n));
    const unsigned m2 = std::max(m1 + 1, static_cast<unsigned>(second_node * n + 0.5));
    const double slope1 = static_cast<double>(events.time(m1 - 1) - now) / m1;
    const double slope2 = static_cast<double>(events.time(m2 - 1) - now) / m2;
    std::int64_t change = nearest(2 * (slope2 - slope1) / (m2 - m1));
    if (std::abs(change) > fine_change) change = nearest(static_cast<double>(change) / coarse_change) * coarse_change;
    if (std::abs(change) > largest_change) continue;
    // After the change is rounded, the interval still places the far node where it belongs.
    const std::int64_t interval = nearest(slope2 - static_cast<double>(change) * (m2 - 1) / 2);
    if (interval < 1 || interval > longest_interval) continue;
    const Timing timing{
        .interval = static_cast<std::uint32_t>(interval), .change = static_cast<std::int32_t>(change), .events = n};
    if (times_hold(events, now, timing)) return timing;
  }
  return single;
}

SegmentFitter::Advance SegmentFitter::advance_master(const Stretch& stretch, std::int64_t position, double first_target,
                                                     unsigned events) const {
  const double ideal = stretch.sign > 0 ? first_target : -first_target;
  const std::int64_t step = nearest(ideal) - along(stretch.sign, position);
  const std::int64_t increment = std::clamp<std::int64_t>(step, 0, whole_step);
  // If a stretch begins between two lines of its grid, a first segment of one event brings the master onto the grid.
  return {.sign = stretch.sign, .increment = increment, .events = step == stretch.grid ? events : 1};
}

SegmentFitter::Advance SegmentFitter::settle(std::int64_t position, double place, unsigned count) const {
  const std::int64_t target = rest_place(place);
  if ((target >> 16) == (position >> 16)) return {.sign = 0, .increment = 0, .events = count};
  const int sign = target > position ? 1 : -1;
  const std::int64_t missing = along(sign, target) - along(sign, position);
  return {.sign = sign, .increment = std::min<std::int64_t>(missing, whole_step), .events = 1};
}

// The first event from `from` to `count` where `margin` is negative. count + 1 if there is none. Mostly there is none:
// a look without an exit comes first, in which the processor takes several events at once. All signs are gathered in
// one.
template <typename Margin>
std::size_t first_below(std::size_t from, std::size_t count, const Margin& margin) {
  std::int64_t signs = 0;
  for (std::size_t k = from; k <= count; ++k) signs |= std::bit_cast<std::int64_t>(margin(k));
  if (signs >= 0) return count + 1;
  while (!std::signbit(margin(from))) ++from;
  return from;
}

// Finds the longest series of events that one increment can serve. Used if the straight guess fails. The series should
// end with the motor at its exact place: an increment at a bound would leave the motor ahead or behind, and then the
// next segment would be short.
//
// Products test whether a quotient is beyond a bound, so that few quotients have to be computed.
SegmentFitter::Advance SegmentFitter::within_bounds(std::int32_t place, std::int32_t count) const {
  const std::int32_t* const ideal = ideal_.data();
  std::int32_t low = 0;
  std::int32_t high = whole_step;
  Advance pushed{.increment = std::clamp<std::int32_t>(ideal[1] - place, 0, whole_step), .events = 1};
  std::int32_t straight = 0;  // number of events
  for (std::int32_t k = 1; k <= count; ++k) {
    const std::int32_t due = step_of(ideal[k]) * whole_step - place;  // not late
    const std::int32_t early =
        step_of(ideal[k + 1]) * whole_step + whole_step - 1 - place;  // not more than one event early
    if (due > low * k) low = ceil_divide(due, k);
    if (early < high * k) high = floor_divide(early, k);
    if (low > high) break;
    const std::int32_t way = ideal[k] - place;
    const bool is_low = way <= (low - 1) * k;
    const bool is_high = way > high * k;
    pushed = {.increment = is_low ? low : high, .events = static_cast<unsigned>(k)};
    if (!is_low && !is_high) straight = k;
  }
  // If the motor is far behind or ahead of its place, no increment fits. Then the best possible one is used.
  if (straight == 0) return pushed;
  return {.increment = ceil_divide(ideal[straight] - place, straight), .events = static_cast<unsigned>(straight)};
}

SegmentFitter::Advance SegmentFitter::advance_other(const EventBuffer& events, unsigned motor, std::int64_t position,
                                                    unsigned count) {
  const double* places = events.places(motor);
  std::size_t first = 1;
  if (std::fabs(places[1] - places[0]) < still) {
    first = first_below(2, count, [places](std::size_t k) { return still - std::fabs(places[k] - places[k - 1]); });
  }
  if (first > count) return settle(position, places[count], count);
  const int direction = places[first] > places[first - 1] ? 1 : -1;
  const double sign = direction;
  // What is behind a turn is left to the next segment.
  const auto moves_on = [places, sign](std::size_t k) { return sign * (places[k] - places[k - 1]) + still; };
  count = static_cast<unsigned>(first_below(first + 1, count, moves_on)) - 1;
  const std::int64_t start = along(direction, position);
  const std::int64_t this_step = start & ~(whole_step - 1);
  const std::int32_t place = static_cast<std::int32_t>(start - this_step);
  const auto ideal = [places, sign, from = static_cast<double>(this_step)](std::size_t k) {
    return floor_to_int_32(sign * places[k] - from);
  };
  // Plain loops over all events: the processor takes several of them at once.
  std::int32_t* const due = ideal_.data();
  for (std::size_t k = 1; k <= count; ++k) due[k] = ideal(k);
  const bool goes_on = events.size() > count && sign * (places[count + 1] - places[count]) > 0;
  due[count + 1] = goes_on ? ideal(count + 1) : due[count];
  // Rounded up, so that a step exactly at an event is not missed by a few 65536ths.
  const auto last = static_cast<std::int32_t>(count);
  const std::int32_t straight = std::clamp<std::int32_t>(ceil_divide(due[count] - place, last), 0, whole_step);
  std::int32_t spare = 0;  // negative where a step comes too late, or more than one event too early
  for (std::int32_t k = 1; k <= last; ++k) {
    const std::int32_t steps = step_of(place + k * straight);
    spare |= (steps - step_of(due[k])) | (step_of(due[k + 1]) - steps);
  }
  Advance advance = spare >= 0 ? Advance{.increment = straight, .events = count} : within_bounds(place, last);
  advance.sign = direction;
  return advance;
}

unsigned SegmentFitter::fit(const EventBuffer& events, const Stretch& stretch, const BoardModel& board,
                            BoardSegment& segment) {
  const std::uint8_t kept_directions = segment.directions;
  const auto most = static_cast<unsigned>(std::min<std::size_t>(events.size(), longest_));
  const Timing timing = fit_time(events, board.time(), most);
  if (timing.events == 0) return 0;

  std::array<Advance, max_motors> advances;
  unsigned count = timing.events;
  advances[stretch.master] =
      advance_master(stretch, board.position(stretch.master), events.places(stretch.master)[1], count);
  count = advances[stretch.master].events;
  // If one motor shortens the segment, the motors before it may need another increment. So repeat until all agree.
  for (bool agreed = false; !agreed;) {
    agreed = true;
    for (unsigned m = 0; m < motors_; ++m) {
      if (m == stretch.master) continue;
      advances[m] = advance_other(events, m, board.position(m), count);
      if (advances[m].events < count) {
        count = advances[m].events;
        agreed = false;
      }
    }
  }

  segment = BoardSegment{.events = static_cast<std::uint16_t>(count),
                         .interval = timing.interval,
                         .change = count > 1 ? timing.change : 0};
  for (unsigned m = 0; m < motors_; ++m) {
    // A motor that stands still keeps its direction line.
    const bool was_down = (kept_directions >> m & 1U) != 0;
    const int sign = advances[m].sign != 0 ? advances[m].sign : (was_down ? -1 : 1);
    set_increment(segment, m, sign, advances[m].increment);
  }
  // Next to a rest a segment has at most two events, and soon after that many. So two events or less are no good guess.
  if (timing.events > 2) guess_ = timing.events;
  return count;
}

}  // namespace passo
