// SegmentFitter: segments in which one motor bends (wire/segment_parts.hpp).
#include <algorithm>
#include <cmath>

#include "fitted_place.hpp"
#include "segment_fitter.hpp"

#include "passo/wire/segment_parts.hpp"

namespace passo {

// The bend of one motor for just so many events, in parts of 2^k events. The increments make a parabola of chords,
// which is aimed between the bounds: half an event early, or at the exact place where a step may be late too.
std::optional<SegmentFitter::Bent> SegmentFitter::bend_of(const EventBuffer& events, unsigned motor,
                                                          std::int64_t position, unsigned count, unsigned k) {
  const double* const places = events.places(motor);
  const auto part = static_cast<std::int64_t>(1) << k;
  const std::int64_t parts = count >> k;
  if (parts < 2) return {};
  const int sign = places[count] > places[0] ? 1 : -1;
  if (sign * (places[1] - places[0]) < -still || count_until_turn(events, motor, 1, sign, count) < count) return {};
  const std::int64_t start = along(sign, position);
  const std::int64_t this_step = start & ~(whole_step - 1);
  find_due(events, motor, sign, this_step, count);
  const std::int32_t* const due = ideal_.data();
  const std::int64_t late = events_late();

  const auto slope_to = [&](std::int64_t m) {
    const auto event = static_cast<std::size_t>(m * part);
    const double early = late != 0 && m != parts ? 0 : (static_cast<double>(due[event + 1]) - due[event]) / 2;
    return (due[event] + early - static_cast<double>(start - this_step)) / static_cast<double>(event);
  };
  const std::int64_t node = std::max<std::int64_t>(1, parts / 2);
  const double slope1 = slope_to(node);
  const double slope2 = slope_to(parts);
  const std::int64_t change = nearest(2 * (slope2 - slope1) / static_cast<double>(parts - node));
  const std::int64_t first = nearest(slope2 - static_cast<double>(change * (parts - 1)) / 2);
  const std::int64_t last = first + change * ((count - 1) >> k);
  if (std::min(first, last) < 1 || std::max(first, last) >= whole_step || std::abs(change) > 0x7fff) return {};

  auto place = static_cast<std::int32_t>(start - this_step);
  auto increment = static_cast<std::int32_t>(first);
  std::int32_t spare = 0;  // negative where a step comes too late, or more than one event too early
  for (std::int64_t from = 1; from <= count; from += part, increment += static_cast<std::int32_t>(change)) {
    const std::int64_t to = std::min<std::int64_t>(count, from + part - 1);
    for (std::int64_t e = from; e <= to; ++e) {
      place += increment;
      spare |= (step_of(place) - step_of(due[e - late])) | (step_of(due[e + 1]) - step_of(place));
    }
    if (spare < 0) return {};
  }
  if (step_of(place) < step_of(due[count])) return {};
  return Bent{.motor = motor,
              .advance = {.sign = sign, .increment = first, .events = count},
              .change = change,
              .form = static_cast<std::uint8_t>(k)};
}

// The number of events up to `count` at which no step of the motor is due, either way.
unsigned SegmentFitter::count_without_step(const EventBuffer& events, unsigned motor, std::int64_t position,
                                           unsigned count) const {
  const double* const places = events.places(motor);
  const auto from = static_cast<double>(position & ~(whole_step - 1));
  unsigned k = 1;
  while (k <= count && places[k] >= from && places[k] < from + whole_step) ++k;
  return k - 1;
}

// Where one motor has to bend, and one makes no step. Changes the other motors' `advances` to serve as many events.
std::optional<SegmentFitter::Bent> SegmentFitter::fit_bend(const EventBuffer& events, const Stretch& stretch,
                                                           const BoardModel& board, const Timing& timing,
                                                           Advances& advances) {
  Advances longer = advances;
  std::optional<unsigned> bent;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == stretch.master) continue;
    longer[m] = advance_other(events, m, board.position(m), timing.events);
    if (!bent || longer[m].events < longer[*bent].events) bent = m;
  }
  unsigned most = 0;
  unsigned lender = 0;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == stretch.master || m == bent) continue;
    const unsigned still_for = count_without_step(events, m, board.position(m), timing.events);
    if (still_for > most) lender = m;
    most = std::max(most, still_for);
  }
  if (most == 0) return {};
  longer[lender] = {};
  const BoardSegment times{.events = static_cast<std::uint16_t>(timing.events),
                           .form = timing.form,
                           .interval = timing.interval,
                           .change = timing.change};
  const std::int64_t last = duration(times, most_events) - duration(times, times.events - 1);
  const double least_part = least_events_of_part(static_cast<double>(std::min<std::int64_t>(timing.interval, last)));
  const unsigned least = longer[*bent].events;
  for (unsigned n = most; n > least + least / 4; n = n * 3 / 4) {
    bool others_serve = true;
    for (unsigned m = 0; m < motors_ && others_serve; ++m) {
      if (m == stretch.master || m == *bent || m == lender) continue;
      longer[m] = advance_other(events, m, board.position(m), n);
      others_serve = longer[m].events == n;
    }
    if (!others_serve) continue;
    const unsigned longest = is_root(timing.form) ? timing.form & ~root_form : longest_root_part;
    for (unsigned k = longest; k > 0 && (1U << k) >= least_part; --k) {
      std::optional<Bent> bend = bend_of(events, *bent, board.position(*bent), n, k);
      if (bend) {
        bend->lender = lender;
        if (is_root(timing.form)) bend->form = timing.form;
        advances = longer;
        advances[*bent] = bend->advance;
        return bend;
      }
      if (is_root(timing.form)) break;
    }
  }
  return {};
}

}  // namespace passo
