#include "shorten.hpp"

#include <cmath>

namespace passo {
namespace {

// A share of the longest time. No phase is cut nearer to one of its ends, so that no part of it is dust: a part takes a
// fiftieth of a move at least, and a move is shorter than allowed by twice that at most.
constexpr double smallest_part_of_phase = 0.02;

// The part of phase `i` after a time, placed from the end of the phase. Placed from its start, a phase that is cut
// 100,000 times would add up as many rounding errors, and no longer meet the phase after it.
Phase part_after(const PlannedMove& move, std::size_t i, Seconds time) {
  Phase part = move.phases[i].after(time);
  const Mm end = i + 1 < move.phase_count ? move.phases[i + 1].start : move.to;
  part.start = end - (part.position_at(part.duration) - part.start);
  return part;
}

}  // namespace

std::optional<PlannedMove> shorten(PlannedMove& move, Seconds longest, Mm least_way) {
  if (std::isinf(longest.value())) return std::nullopt;
  const Seconds small = longest * smallest_part_of_phase;
  Seconds left = longest * (1 - smallest_part_of_phase);
  std::size_t whole = 0;  // phases that stay whole
  for (; whole < move.phase_count && move.phases[whole].duration <= left + small; ++whole) {
    left -= move.phases[whole].duration;
  }
  if (whole == move.phase_count) return std::nullopt;
  const bool is_between = left < small;
  const Phase after = is_between ? move.phases[whole] : part_after(move, whole, left);
  if (whole + 1 == move.phase_count && move.to - after.start < least_way) return std::nullopt;

  std::optional<PlannedMove> rest = move;
  rest->phase_count = 0;
  rest->add(after);
  for (std::size_t i = whole + 1; i < move.phase_count; ++i) rest->add(move.phases[i]);
  move.phase_count = whole;
  if (!is_between) move.phases[move.phase_count++].duration = left;
  move.to = after.start;
  return rest;
}

}  // namespace passo
