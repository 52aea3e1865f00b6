// PowerParts: divides a move whose laser power follows the speed into parts of one power each.
//
// The power of a part is that of its mean speed. So each part gets the energy per millimetre of the programmed speed,
// whatever the speed does inside the part.
//
// A change of power costs the link two items or more, so changes have a least distance in time (`longest_ramp` divided
// by the number of levels). Where the speed changes sooner, the power stays, and the next parts get what is owed to the
// path or what it got too much. A change of the programmed power is not delayed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "passo/trajectory/phase.hpp"

namespace passo {

class PowerParts {
 public:
  // 5 ms with 32 levels, 10 ms with 16.
  static constexpr Seconds longest_ramp{0.16};
  // Powers are multiples of this, so that an even speed has one power.
  static constexpr double finest_power = 1.0 / 256;

  // Begins a move with its first part, if it must be divided. `levels`: between standstill and the programmed speed;
  // their number may change from part to part.
  void begin(const PlannedMove& move, int levels) {
    phase_ = 0;
    from_ = 0;
    in_parts_ = move.segment.outputs.follows_speed && move.segment.outputs.power > 0;
    if (!in_parts_) programmed_ = 0;
    if (in_parts_) go_on(move, levels);
  }
  // Goes on to the next part of that move. Returns false if there is none.
  [[nodiscard]] bool next(const PlannedMove& move, int levels) {
    in_parts_ = in_parts_ && phase_ < move.phase_count;
    if (in_parts_) go_on(move, levels);
    return in_parts_;
  }
  // The current part, or else the whole move.
  const PlannedMove& part_of(const PlannedMove& move) const { return in_parts_ ? part_ : move; }

 private:
  void go_on(const PlannedMove& move, int levels) {
    const Phase& phase = move.phases[phase_];
    Phase slice = from_ > 0 ? phase.after(Seconds(from_)) : phase;
    const Seconds shortest = longest_ramp / levels;
    const double parts = parts_of(slice, move.segment.speed / levels, shortest);
    const bool ends_phase = parts == 1;
    const bool ends_move = ends_phase && phase_ + 1 == move.phase_count;
    if (!ends_phase) slice.duration = slice.duration / parts;
    const Mm phase_end = ends_move ? move.to : ends_phase ? move.phases[phase_ + 1].start : Mm(0);
    part_.begin_on(move.segment);
    part_.add(slice);
    part_.to = ends_phase ? phase_end : phase.position_at(Seconds(from_ + slice.duration.value()));
    part_.stops_at_once = ends_move && move.stops_at_once;
    part_.segment.outputs.power = power_of(part_, move.segment, shortest);
    from_ = ends_phase ? 0 : from_ + slice.duration.value();
    phase_ += ends_phase ? 1 : 0;
  }
  // Of what is left of a phase.
  static double parts_of(const Phase& phase, MmPerSecond level, Seconds shortest) {
    const double change = std::abs((phase.velocity_at(phase.duration) - phase.velocity).value());
    const double most = std::floor(phase.duration / shortest);
    return std::max(std::min(std::ceil(change / level.value()), most), 1.0);
  }
  double power_of(const PlannedMove& part, const Segment& whole, Seconds shortest) {
    const double duration = part.duration().value();
    const double mean = duration > 0 ? (part.to - part.from()).value() / duration : 0;
    const double wanted = std::min(whole.outputs.power * mean / whole.speed.value(), 1.0);
    if (std::exchange(programmed_, whole.outputs.power) != whole.outputs.power) {
      owed_ = 0;
      change_to(wanted);
    } else if (held_ >= shortest) {
      change_to(wanted + owed_ / std::max(duration, shortest.value()));
    }
    held_ = held_ + Seconds(duration);
    owed_ = std::clamp(owed_ + (wanted - power_) * duration, -shortest.value(), shortest.value());
    return power_;
  }
  void change_to(double power) {
    const double rounded = std::round(std::clamp(power, 0.0, 1.0) / finest_power) * finest_power;
    if (std::exchange(power_, rounded) != rounded) held_ = Seconds(0);
  }

  PlannedMove part_;
  bool in_parts_ = false;
  std::size_t phase_ = 0;
  double from_ = 0;  // time in the phase
  double programmed_ = 0;
  double power_ = 0;
  Seconds held_{0};  // how long it has been so
  double owed_ = 0;  // to the path: power times seconds
};

}  // namespace passo
