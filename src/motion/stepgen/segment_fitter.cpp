#include "segment_fitter.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "fitted_place.hpp"

#include "passo/wire/segment_parts.hpp"

namespace passo {
namespace {

// An interval must fit the board's timer.
constexpr std::int64_t longest_interval = 65535 * whole_tick;
// The places where the error of the fit is zero, as shares of the segment. They are the zeros of the Chebyshev
// polynomial T3, moved so that the first zero is at the start.
constexpr double first_node = 0.464;
constexpr double second_node = 0.928;
// What a part and an event cost a chip, in the board's shortest intervals: board_test.cpp plays just such parts. At
// least so many parts are left to the rest, because the board takes a series for the root.
constexpr double cost_of_part = 50;
constexpr double cost_of_event = 0.7;
constexpr double parts_to_rest = 2;
// So much a motor that has caught up may be ahead, in 1/65536 step: rounding.
constexpr std::int64_t hair = 2;

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
template <typename Int>
Int ceil_divide(Int a, Int b) {
  return a >= 0 ? (a + b - 1) / b : -(-a / b);
}
template <typename Int>
Int floor_divide(Int a, Int b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
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
  return part_holds(events, now, timing, 0);
}

// The same for one quadratic: `timing` begins at `now`, with the event number `first`.
bool SegmentFitter::part_holds(const EventBuffer& events, std::int64_t now, const Timing& timing,
                               unsigned first) const {
  std::int64_t interval = timing.interval;
  std::int64_t time = now;
  for (unsigned k = first; k < first + timing.events; ++k) {
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

// A root serves where the path speeds up or brakes evenly. It is not tried where events must be exact to the tick: then
// there is no line to relieve.
SegmentFitter::Timing SegmentFitter::fit_time(const EventBuffer& events, std::int64_t now, unsigned most) {
  const Timing quadratic = fit_quadratic(events, now, most);
  // Next to a rest a segment has at most two events, and soon after that many. So two events or less are no good guess.
  if (quadratic.events > 2) guess_ = quadratic.events;
  if (share_ == 0 || quadratic.events < 2 || quadratic.events == most) return quadratic;
  const Timing root = fit_root(events, now, most, quadratic.events);
  return root.events > quadratic.events ? root : quadratic;
}

// The number of events in the shortest part that a chip has time for, where events come that fast. More than any part
// has: there is no time at all.
double SegmentFitter::least_events_of_part(double interval) const {
  const double spare = interval / static_cast<double>(shortest_interval_) - cost_of_event;
  return spare > 0 ? cost_of_part / spare : std::numeric_limits<double>::infinity();
}

// Finds a long root of more than `least` events, if there is one.
SegmentFitter::Timing SegmentFitter::fit_root(const EventBuffer& events, std::int64_t now, unsigned most,
                                              unsigned least) const {
  Timing longest;
  unsigned too_many = most + 1;
  for (unsigned n = most; n > least; n = n * 3 / 4) {
    const std::optional<Timing> root = root_of(events, now, n);
    if (root && root_holds(events, now, *root)) {
      longest = *root;
      break;
    }
    too_many = n;
  }
  // Between what holds and what does not.
  for (int round = 0; round < 2 && longest.events > 0 && too_many - longest.events > 1; ++round) {
    const unsigned n = (longest.events + too_many) / 2;
    const std::optional<Timing> root = root_of(events, now, n);
    if (root && root_holds(events, now, *root)) {
      longest = *root;
    } else {
      too_many = n;
    }
  }
  return longest;
}

bool SegmentFitter::root_holds(const EventBuffer& events, std::int64_t now, const Timing& root) const {
  const BoardSegment segment{.events = static_cast<std::uint16_t>(root.events),
                             .form = root.form,
                             .interval = root.interval,
                             .change = root.change};
  bool holds = true;
  for_each_part(segment, [&](const PartTimes& part, unsigned count, unsigned first) {
    const Timing timing{.interval = part.interval, .change = part.change, .events = count};
    holds = holds && part_holds(events, now, timing, first);
    now += std::int64_t{count} * part.interval + std::int64_t{part.change} * (count * (count - 1) / 2);
  });
  return holds;
}

// The root that meets the events at two nodes. Event k of an even acceleration comes at a time t with k = v t - a t²/2,
// which is linear in v and a. The board's parts are chords of the curve. So the nodes are aimed at a second time, by as
// much beside the exact times as the first root was off.
std::optional<SegmentFitter::Timing> SegmentFitter::root_of(const EventBuffer& events, std::int64_t now,
                                                            unsigned n) const {
  const unsigned k1 = n / 2;
  const unsigned k2 = n;
  if (k1 == 0) return {};
  const auto exact1 = static_cast<double>(events.time(k1 - 1) - now);
  const auto exact2 = static_cast<double>(events.time(k2 - 1) - now);
  double t1 = exact1;
  double t2 = exact2;
  Timing root{.events = n};
  for (int round = 0; round < 3; ++round) {
    if (t1 <= 0 || t2 <= t1) return {};
    const double v = (k1 * t2 / t1 - k2 * t1 / t2) / (t2 - t1);
    const double a = 2 * (v * t2 - k2) / (t2 * t2);
    if (v <= 0 || a == 0) return {};
    const double rest = v * v / (2 * a);  // so many events ahead; negative: behind
    const double nearest_rest = a > 0 ? rest - n : -rest;
    const double fastest = 1 / std::sqrt(a > 0 ? v * v : v * v - 2 * a * n);  // the shortest interval
    const double least_part = least_events_of_part(fastest);
    unsigned k = 0;
    while (k < longest_root_part && (1U << k) < least_part) ++k;
    const double part = 1U << k;
    if (part < least_part || part * parts_to_rest > nearest_rest || part * 2 > n) return {};
    const double interval = 1 / std::sqrt(v * v - a);
    if (!(interval >= 1 && interval <= longest_interval)) return {};
    std::int64_t growth = nearest(part / rest * 2147483648.0);
    if (std::abs(growth) > fine_change) growth = nearest(static_cast<double>(growth) / coarse_change) * coarse_change;
    root.interval = static_cast<std::uint32_t>(interval + 0.5);
    root.change = static_cast<std::int32_t>(growth);
    root.form = static_cast<std::uint8_t>(root_form + k);
    const BoardSegment segment{
        .events = static_cast<std::uint16_t>(n), .form = root.form, .interval = root.interval, .change = root.change};
    t1 += exact1 - static_cast<double>(duration(segment, static_cast<int>(k1)));
    t2 += exact2 - static_cast<double>(duration(segment, static_cast<int>(k2)));
  }
  return root;
}

SegmentFitter::Timing SegmentFitter::fit_quadratic(const EventBuffer& events, std::int64_t now, unsigned most) {
  // A segment of one event always meets the event exactly, unless the event is too near or too far.
  const std::int64_t first = events.time(0) - now;
  // An event may come early by a share of its interval.
  const std::int64_t early = share_ == 0 ? 0 : longest_interval / share_;
  if (first > longest_interval + early) return {};
  const Timing single{.interval = static_cast<std::uint32_t>(std::clamp(first, shortest_interval_, longest_interval)),
                      .events = 1};

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
  return first < shortest_interval_ ? fit_late(events, now, most) : single;
}

// The board is late, and no event may come sooner after the one before it: one segment of the shortest intervals up to
// the first event that is in time again. At the highest rate that takes many events, and a segment for each of them
// would be more than a chip has time for.
SegmentFitter::Timing SegmentFitter::fit_late(const EventBuffer& events, std::int64_t now, unsigned most) const {
  Timing timing{.interval = static_cast<std::uint32_t>(shortest_interval_), .events = 1};
  for (; timing.events < most; ++timing.events) {
    now += shortest_interval_;
    if (now <= events.time(timing.events - 1)) break;
  }
  return timing;
}

SegmentFitter::Advance SegmentFitter::advance_master(const Stretch& stretch, std::int64_t position, double first_target,
                                                     unsigned events) const {
  const double ideal = stretch.sign > 0 ? first_target : -first_target;
  const std::int64_t step = nearest(ideal) - along(stretch.sign, position);
  const std::int64_t increment = std::clamp<std::int64_t>(step, 0, whole_step);
  // If a stretch begins between two lines of its grid, a first segment of one event brings the master onto the grid.
  // Over a line, a master of whole steps that was ahead by rounding, or had no time to catch up, makes them all the
  // same. Where a step may be an event off, it does so between any two lines: each event still brings one step.
  const std::int64_t least = events_late() != 0 ? 1 : whole_step - hair;
  const bool steps_at_events = share_ != 0 && stretch.grid == whole_step && step >= least;
  const bool is_on_grid = steps_at_events || step == stretch.grid;
  return {.sign = stretch.sign, .increment = is_on_grid ? stretch.grid : increment, .events = is_on_grid ? events : 1};
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

// The first event up to `count` at which the motor has moved. count + 1: it stands still.
std::size_t SegmentFitter::first_move(const EventBuffer& events, unsigned motor, unsigned count) {
  const double* const places = events.places(motor);
  if (std::fabs(places[1] - places[0]) >= still) return 1;
  return first_below(2, count, [places](std::size_t k) { return still - std::fabs(places[k] - places[k - 1]); });
}

// What is behind a turn is left to the next segment. From event `first` on the motor moves in direction `sign`.
unsigned SegmentFitter::count_until_turn(const EventBuffer& events, unsigned motor, std::size_t first, int sign,
                                         unsigned count) const {
  const double* const places = events.places(motor);
  const auto moves_on = [places, way = double(sign)](std::size_t k) {
    return way * (places[k] - places[k - 1]) + still;
  };
  return static_cast<unsigned>(first_below(first + 1, count, moves_on)) - 1;
}

// Fills ideal_ up to the event after `count`. Plain loops over all events: the processor takes several at once.
void SegmentFitter::find_due(const EventBuffer& events, unsigned motor, int sign, std::int64_t this_step,
                             unsigned count) {
  const double* const places = events.places(motor);
  const auto ideal = [places, way = double(sign), from = static_cast<double>(this_step)](std::size_t k) {
    return floor_to_int_32(way * places[k] - from);
  };
  std::int32_t* const due = ideal_.data();
  for (std::size_t k = 1; k <= count; ++k) due[k] = ideal(k);
  due[0] = due[1];
  const bool goes_on = events.size() > count && sign * (places[count + 1] - places[count]) > 0;
  due[count + 1] = goes_on ? ideal(count + 1) : due[count];
}

SegmentFitter::Advance SegmentFitter::advance_other(const EventBuffer& events, unsigned motor, std::int64_t position,
                                                    unsigned count) {
  const double* places = events.places(motor);
  const std::size_t first = first_move(events, motor, count);
  if (first > count) return settle(position, places[count], count);
  const int direction = places[first] > places[first - 1] ? 1 : -1;
  count = count_until_turn(events, motor, first, direction, count);
  const std::int64_t start = along(direction, position);
  const std::int64_t this_step = start & ~(whole_step - 1);
  const std::int32_t place = static_cast<std::int32_t>(start - this_step);
  find_due(events, motor, direction, this_step, count);
  const std::int32_t* const due = ideal_.data();
  // Rounded up, so that a step exactly at an event is not missed by a few 65536ths.
  const auto last = static_cast<std::int32_t>(count);
  const std::int32_t straight = std::clamp<std::int32_t>(ceil_divide(due[count] - place, last), 0, whole_step);
  const std::int32_t late = events_late();
  std::int32_t spare = 0;  // negative where a step comes too late, or more than one event too early
  for (std::int32_t k = 1; k <= last; ++k) {
    const std::int32_t steps = step_of(place + k * straight);
    spare |= (steps - step_of(due[k - late])) | (step_of(due[k + 1]) - steps);
  }
  if (step_of(place + last * straight) < step_of(due[count])) spare = -1;
  Advance advance = spare >= 0 ? Advance{.increment = straight, .events = count} : within_bounds(place, last);
  advance.sign = direction;
  return advance;
}

// A motor that stands still keeps its direction line.
void SegmentFitter::write(const Advances& advances, std::uint8_t kept_directions, BoardSegment& segment) const {
  for (unsigned m = 0; m < motors_; ++m) {
    const bool was_down = (kept_directions >> m & 1U) != 0;
    const int sign = advances[m].sign != 0 ? advances[m].sign : (was_down ? -1 : 1);
    set_increment(segment, m, sign, advances[m].increment);
  }
}

unsigned SegmentFitter::fit(const EventBuffer& events, const Stretch& stretch, const BoardModel& board,
                            BoardSegment& segment) {
  if (share_ != 0 && catch_up(events, stretch, board, false, segment)) return 1;
  const std::uint8_t kept_directions = segment.directions;
  const auto most = static_cast<unsigned>(std::min<std::size_t>(events.size(), longest_));
  const Timing timing = fit_time(events, board.time(), most);
  if (timing.events == 0) return 0;

  Advances advances;
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
  // A step at each event, and still too slow for two.
  const auto lags = [](const Advance& advance) { return advance.events == 1 && advance.increment == whole_step; };
  const bool any_lags = share_ != 0 && count == 1 && timing.events > 1 && std::ranges::any_of(advances, lags);
  if (any_lags && catch_up(events, stretch, board, true, segment)) return 1;

  std::optional<Bending> bending;
  if (bends_ && share_ != 0 && count < timing.events && advances[stretch.master].events == timing.events) {
    bending = fit_bend(events, stretch, board, timing, advances);
    if (bending) count = bending->events;
  }
  // A root's parts are its own.
  const std::uint8_t form = bending && !is_root(timing.form) ? static_cast<std::uint8_t>(bending->k) : timing.form;
  segment = BoardSegment{.events = static_cast<std::uint16_t>(count),
                         .form = count > 1 ? form : std::uint8_t{0},
                         .interval = timing.interval,
                         .change = count > 1 ? timing.change : 0};
  write(advances, kept_directions, segment);
  if (bending) {
    segment.bend = bending->code;
    segment.increments[bending->lender] = bending->lent;
  }
  return count;
}

}  // namespace passo
