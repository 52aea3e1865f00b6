// Phase: a piece of motion with constant jerk along the path. PlannedMove: a segment, or a part of one, and its phases.
//
// s(t) = s0 + v0 t + a0 t²/2 + j t³/6 for 0 <= t <= duration, with s along the segment's curve. The phases of a move
// follow each other without a gap. A segment with more phases than fit into a move becomes several moves. The first
// begins at s = 0, each later one at the end of the previous one, and the last ends at the curve's length.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <variant>

#include "passo/path/segment.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Phase {
  Seconds duration{0};
  Mm start{0};
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};

  constexpr Mm position_at(Seconds t) const {
    const double u = t.value();
    return Mm(start.value() + u * (velocity.value() + u * (acceleration.value() / 2 + u * jerk.value() / 6)));
  }
  constexpr MmPerSecond velocity_at(Seconds t) const {
    const double u = t.value();
    return MmPerSecond(velocity.value() + u * (acceleration.value() + u * jerk.value() / 2));
  }
  constexpr MmPerSecond2 acceleration_at(Seconds t) const { return acceleration + jerk * t; }
  // The remainder of the phase from there on.
  constexpr Phase after(Seconds t) const {
    return {.duration = duration - t,
            .start = position_at(t),
            .velocity = velocity_at(t),
            .acceleration = acceleration_at(t),
            .jerk = jerk};
  }
};

struct PlannedMove {
  static constexpr std::size_t most_phases = 16;

  Segment segment;
  std::array<Phase, most_phases> phases;
  std::size_t phase_count = 0;

  // Starts a move on that segment, without phases.
  void begin_on(const Segment& whole) {
    segment = whole;
    phase_count = 0;
    stops_at_once = false;
  }
  void add(const Phase& phase) {
    assert(phase_count < most_phases);
    phases[phase_count++] = phase;
  }
  const Phase* begin() const { return phases.data(); }
  const Phase* end() const { return phases.data() + phase_count; }
  // The part of the curve that the move covers: from the start of its first phase,
  Mm from() const { return phase_count > 0 ? phases[0].start : Mm(0); }
  Mm to{0};  // to here
  // Whether the motors stop at once from the velocities at the end, which their start-stop velocities allow. Set at the
  // end of a hold; at a stop of the path an action follows, or the next motion.
  bool stops_at_once = false;
  Seconds duration() const {
    Seconds sum{0};
    for (const Phase& phase : *this) sum += phase.duration;
    return sum;
  }
  // The velocity at the end of a move that has phases.
  MmPerSecond exit_velocity() const {
    const Phase& last = phases[phase_count - 1];
    return last.velocity_at(last.duration);
  }
  // Whether the machine is stopped after the move: all axes are, except for rounding errors, or the motors stop at
  // once. This tests the axes, not the speed along the path, because on an extremely short segment a rotary axis may
  // turn by a hundred thousand degrees per millimetre.
  bool ends_at_rest() const {
    constexpr double rest_speed =
        1e-6;  // mm/s or degrees/s; at this speed, a step takes half a minute on the finest machine
    if (phase_count == 0 || stops_at_once) return true;
    const double speed = exit_velocity().value();
    if (speed >= rest_speed) return false;
    const Point slope = segment.curve.tangent(to);
    return std::ranges::all_of(slope.values, [&](double part) { return std::abs(part) * speed < rest_speed; });
  }
};

using MotionItem = std::variant<PlannedMove, Action>;

}  // namespace passo
