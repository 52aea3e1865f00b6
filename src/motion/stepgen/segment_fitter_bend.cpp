// SegmentFitter: segments in which one motor bends (wire/segment_parts.hpp).
#include <algorithm>
#include <cmath>

#include "fitted_place.hpp"
#include "segment_fitter.hpp"

#include "passo/wire/segment_parts.hpp"

namespace passo {

namespace {

// The changes of two motors have a byte each, and a scale.
constexpr std::int64_t most_of_byte = 127;
// So often the number of events is looked for between what bends and what does not.
constexpr int rounds_between = 2;

}  // namespace

// The bend of one motor. The increments make a parabola of chords, which is aimed between the bounds: half an event
// early, or at the exact place where a step may be late too.
std::optional<SegmentFitter::Bent> SegmentFitter::bend_of(const BendSpan& span, unsigned motor, BendRange range) {
  const EventBuffer& events = span.events;
  const std::int64_t count = span.count;
  const double* const places = events.places(motor);
  const auto part = static_cast<std::int64_t>(1) << span.k;
  const std::int64_t parts = count >> span.k;
  if (parts < 2) return {};
  const int sign = places[count] > places[0] ? 1 : -1;
  if (sign * (places[1] - places[0]) < -still || count_until_turn(events, motor, 1, sign, span.count) < span.count) {
    return {};
  }
  const std::int64_t start = along(sign, span.board.position(motor));
  const std::int64_t this_step = start & ~(whole_step - 1);
  find_due(events, motor, sign, this_step, span.count);
  const std::int32_t* const due = ideal_.data();
  const std::int64_t late = events_late();

  const auto slope_to = [&](std::int64_t m, double shift) {
    const auto event = static_cast<std::size_t>(m * part);
    const double early = late != 0 && m != parts ? 0 : (static_cast<double>(due[event + 1]) - due[event]) / 2;
    return (due[event] + early + shift - static_cast<double>(start - this_step)) / static_cast<double>(event);
  };
  const std::int64_t node = std::max<std::int64_t>(1, parts / 2);
  const auto change_of = [&](double slope1, double slope2) {
    return 2 * (slope2 - slope1) / static_cast<double>(parts - node);
  };
  // Amid a part the chord is an eighth of part times change beside the parabola, to one side. Half of that is aimed
  // for at the nodes.
  const double shift = -change_of(slope_to(node, 0), slope_to(parts, 0)) * static_cast<double>(part) / 16;
  const double slope2 = slope_to(parts, shift);
  const double wanted = change_of(slope_to(node, shift), slope2);
  const std::int64_t change = range.unit * nearest(wanted / static_cast<double>(range.unit));
  const std::int64_t first = nearest(slope2 - static_cast<double>(change * (parts - 1)) / 2);
  const std::int64_t last = first + change * ((count - 1) >> span.k);
  if (std::min(first, last) < 1 || std::max(first, last) >= whole_step || std::abs(change) > range.most) return {};

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
  return Bent{.advance = {.sign = sign, .increment = first, .events = span.count}, .change = sign * change};
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

// A motor that makes no step lends its place to one that bends. A master that steps at every event needs no place for
// its increment, and two motors share it. It goes before a motor that will step: that motor would then be behind by
// most of a step, and need a segment of its own to catch up.
std::optional<SegmentFitter::Lending> SegmentFitter::find_lender(const EventBuffer& events, const Stretch& stretch,
                                                                 const BoardModel& board, const Advances& advances,
                                                                 unsigned bent, unsigned count) const {
  Lending lending{.first = bent, .second = bent};
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == stretch.master || m == bent) continue;
    const unsigned still_for = count_without_step(events, m, board.position(m), count);
    if (still_for > lending.most) lending.lender = m;
    lending.most = std::max(lending.most, still_for);
  }
  if (lending.most < count && motors_ >= least_motors_to_bend_two && advances[stretch.master].increment == whole_step) {
    const auto lender = static_cast<std::uint8_t>(stretch.master);
    lending = {.lender = lender, .first = first_beside(lender), .second = second_beside(lender), .most = count};
  }
  if (lending.most == 0) return {};
  // A bend ends where a motor turns.
  for (const unsigned m : {lending.first, lending.second}) {
    const std::size_t first = first_move(events, m, lending.most);
    if (first > lending.most) continue;
    const int sign = events.places(m)[first] > events.places(m)[first - 1] ? 1 : -1;
    lending.most = count_until_turn(events, m, first, sign, lending.most);
  }
  return lending;
}

std::optional<SegmentFitter::Bending> SegmentFitter::bend_one(const BendSpan& span, const Lending& lending,
                                                              Advances& advances) {
  const std::optional<Bent> bent = bend_of(span, lending.first, {});
  if (!bent) return {};
  advances[lending.first] = bent->advance;
  advances[lending.lender] = {};
  return Bending{.code = static_cast<std::uint8_t>(lending.first | lending.lender << bend_shift<max_motors>),
                 .lent = static_cast<std::uint16_t>(bent->change),
                 .lender = lending.lender,
                 .events = span.count};
}

// A motor that one increment serves, as `advances` says, has no change.
std::optional<SegmentFitter::Bending> SegmentFitter::bend_two(const BendSpan& span, const Lending& lending,
                                                              Advances& advances) {
  for (std::uint8_t scale = 1; scale <= largest_scale; ++scale) {
    const std::int64_t unit = 1 << 2 * scale;
    const auto bent = [&](unsigned motor) -> std::optional<Bent> {
      if (advances[motor].events == span.count) return Bent{.advance = advances[motor]};
      return bend_of(span, motor, {.unit = unit, .most = most_of_byte * unit});
    };
    const std::optional<Bent> first = bent(lending.first);
    if (!first) continue;
    const std::optional<Bent> second = bent(lending.second);
    if (!second) continue;
    advances[lending.first] = first->advance;
    advances[lending.second] = second->advance;
    const auto byte = [unit](std::int64_t change) { return static_cast<std::uint8_t>(change / unit); };
    return Bending{.code = static_cast<std::uint8_t>(scale | lending.lender << bend_shift<max_motors>),
                   .lent = static_cast<std::uint16_t>(byte(first->change) | byte(second->change) << 8),
                   .lender = lending.lender,
                   .events = span.count};
  }
  return {};
}

// The parts that the chip has time for, of two to the power of these many events. A root has chosen its own.
SegmentFitter::PartRange SegmentFitter::parts_of(const Timing& timing) const {
  const BoardSegment times{.events = static_cast<std::uint16_t>(timing.events),
                           .form = timing.form,
                           .interval = timing.interval,
                           .change = timing.change};
  const std::int64_t last = duration(times, most_events) - duration(times, times.events - 1);
  const double least_part = least_events_of_part(static_cast<double>(std::min<std::int64_t>(timing.interval, last)));
  PartRange parts{.longest = longest_root_part};
  if (is_root(timing.form)) parts.shortest = parts.longest = timing.form & ~root_form;
  parts.shortest = std::max(parts.shortest, 1U);
  while (parts.shortest <= parts.longest && (1U << parts.shortest) < least_part) ++parts.shortest;
  return parts;
}

// Finds the longest parts in which just so many events bend.
std::optional<SegmentFitter::Bending> SegmentFitter::bend_by(const Lending& lending, BendSpan span, PartRange parts,
                                                             unsigned master, Advances& advances) {
  const bool one = lending.first == lending.second;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == master || (one && lending.serves(m))) continue;
    advances[m] = advance_other(span.events, m, span.board.position(m), span.count);
    if (!lending.serves(m) && advances[m].events != span.count) return {};
  }
  for (span.k = parts.longest; span.k >= parts.shortest; --span.k) {
    std::optional<Bending> bending = one ? bend_one(span, lending, advances) : bend_two(span, lending, advances);
    if (!bending) continue;
    bending->k = span.k;
    return bending;
  }
  return {};
}

// Where motors have to bend, and one has a place to lend. Changes the other motors' `advances` to serve as many events.
std::optional<SegmentFitter::Bending> SegmentFitter::fit_bend(const EventBuffer& events, const Stretch& stretch,
                                                              const BoardModel& board, const Timing& timing,
                                                              Advances& advances) {
  Advances tried = advances;
  std::optional<unsigned> worst;
  for (unsigned m = 0; m < motors_; ++m) {
    if (m == stretch.master) continue;
    tried[m] = advance_other(events, m, board.position(m), timing.events);
    if (!worst || tried[m].events < tried[*worst].events) worst = m;
  }
  const std::optional<Lending> lending = find_lender(events, stretch, board, tried, *worst, timing.events);
  if (!lending) return {};
  const PartRange parts = parts_of(timing);
  const unsigned without = tried[*worst].events;
  const unsigned worth_it = without + without / 4;
  std::optional<Bending> longest;
  unsigned too_many = lending->most + 1;
  const auto bends = [&](unsigned n) {
    const BendSpan span{.events = events, .board = board, .count = n};
    const std::optional<Bending> bending = bend_by(*lending, span, parts, stretch.master, tried);
    if (!bending) {
      too_many = n;
      return;
    }
    longest = bending;
    advances = tried;
  };
  for (unsigned n = lending->most; !longest && n > worth_it; n = n * 3 / 4) bends(n);
  for (int round = 0; longest && round < rounds_between; ++round) bends((longest->events + too_many) / 2);
  return longest;
}

}  // namespace passo
