// Motion for tests, similar to that of a smoother and a planner with jerk limits: a chain of cubics with a continuous
// second derivative, and phases of constant jerk along the chain. Both are divided into moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "passo/geometry/curve.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo::test {

// Returns the natural cubic spline through `points`, parametrised by the chord length.
inline std::vector<Curve> spline_through(const std::vector<Point>& points) {
  const std::size_t n = points.size();
  std::vector<double> length;
  for (std::size_t i = 0; i + 1 < n; ++i) length.push_back(Curve::line(points[i], points[i + 1]).length().value());
  std::vector<Point> tangents(n);
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    // The equation for each point is below·m[i-1] + middle·m[i] + above·m[i+1] = right. Elimination goes from start to
    // end, substitution back.
    std::vector<double> factor(n);
    std::vector<double> rest(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double before = i > 0 ? 1 / length[i - 1] : 0;
      const double behind = i + 1 < n ? 1 / length[i] : 0;
      const auto rise = [&](std::size_t k) { return points[k + 1].values[axis] - points[k].values[axis]; };
      double right = 0;
      if (i > 0) right += 3 * before * before * rise(i - 1);
      if (i + 1 < n) right += 3 * behind * behind * rise(i);
      const double middle = 2 * (before + behind) - (i > 0 ? before * factor[i - 1] : 0);
      factor[i] = behind / middle;
      rest[i] = (right - (i > 0 ? before * rest[i - 1] : 0)) / middle;
    }
    for (std::size_t i = n; i-- > 0;) {
      tangents[i].values[axis] = rest[i] - (i + 1 < n ? factor[i] * tangents[i + 1].values[axis] : 0);
    }
  }
  std::vector<Curve> curves;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    curves.push_back(Curve::cubic(points[i], tangents[i], points[i + 1], tangents[i + 1], Mm(length[i])));
  }
  return curves;
}

// A sequence of phases, beginning at standstill. The start of each phase is relative to the start of the first phase.
class PhaseChain {
 public:
  // Changes from the current speed to `speed` in `duration`. At the start and at the end, the acceleration changes for
  // a fraction `share` of the duration. With 0, the acceleration is constant. With 1/2, there is jerk all the time.
  void change_speed(double speed, double duration, double share) {
    const double acceleration = (speed - speed_) / (duration * (1 - share));
    const double ramp = share * duration;
    if (ramp > 0) add(ramp, 0, acceleration / ramp);
    if (duration > 2 * ramp) add(duration - 2 * ramp, acceleration, 0);
    if (ramp > 0) add(ramp, acceleration, -acceleration / ramp);
    speed_ = speed;
  }
  void cruise(double duration) { add(duration, 0, 0); }

  // Returns the same motion, scaled to `length` and a maximum speed of `speed`.
  std::vector<Phase> over(double length, double speed) const {
    const double way = length / length_;
    const double time = way * top_ / speed;
    std::vector<Phase> phases = phases_;
    for (Phase& phase : phases) {
      phase.duration = phase.duration * time;
      phase.start = phase.start * way;
      phase.velocity = phase.velocity * (way / time);
      phase.acceleration = phase.acceleration * (way / (time * time));
      phase.jerk = phase.jerk * (way / (time * time * time));
    }
    return phases;
  }

 private:
  void add(double duration, double acceleration, double jerk) {
    const Phase phase{.duration = Seconds(duration),
                      .start = Mm(length_),
                      .velocity = MmPerSecond(speed_),
                      .acceleration = MmPerSecond2(acceleration),
                      .jerk = MmPerSecond3(jerk)};
    length_ = phase.position_at(phase.duration).value();
    speed_ = phase.velocity_at(phase.duration).value();
    top_ = std::max(top_, speed_);
    phases_.push_back(phase);
  }

  std::vector<Phase> phases_;
  double length_ = 0;
  double speed_ = 0;
  double top_ = 0;
};

// Divides the phases at each of the positions `cuts`, which are in ascending order.
inline std::vector<Phase> cut_at(const std::vector<double>& cuts, const std::vector<Phase>& phases) {
  constexpr double nothing = 1e-9;  // mm
  std::vector<Phase> pieces;
  auto cut = cuts.begin();
  for (Phase phase : phases) {
    const auto position = [&](double t) { return phase.position_at(Seconds(t)).value(); };
    for (; cut != cuts.end() && *cut < position(phase.duration.value()) - nothing; ++cut) {
      if (*cut < phase.start.value() + nothing) continue;
      double low = 0;
      double high = phase.duration.value();
      for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (position(middle) < *cut ? low : high) = middle;
      }
      const Seconds t(high);
      pieces.push_back(phase);
      pieces.back().duration = t;
      phase = {.duration = phase.duration - t,
               .start = Mm(*cut),
               .velocity = phase.velocity_at(t),
               .acceleration = phase.acceleration + phase.jerk * t,
               .jerk = phase.jerk};
    }
    pieces.push_back(phase);
  }
  return pieces;
}

// Returns moves for the phases along all curves. Each move is on one curve, covers at most the length `part` of it, and
// has at most as many phases as a move can contain.
inline std::vector<MotionItem> moves_along(const std::vector<Curve>& curves, const std::vector<Phase>& phases,
                                           double part) {
  std::vector<double> cuts;
  std::vector<double> starts;  // start position of each curve
  double end = 0;
  for (const Curve& curve : curves) {
    starts.push_back(end);
    for (double s = part; s < curve.length().value() - part / 100; s += part) cuts.push_back(end + s);
    end += curve.length().value();
    cuts.push_back(end);
  }
  cuts.pop_back();

  std::vector<MotionItem> items;
  std::size_t curve = 0;
  double part_end = 0;  // end position of the current move
  for (const Phase& phase : cut_at(cuts, phases)) {
    const double middle = phase.position_at(phase.duration / 2).value();
    auto* move = items.empty() ? nullptr : &std::get<PlannedMove>(items.back());
    if (move == nullptr || middle > part_end || move->phase_count == PlannedMove::most_phases) {
      const bool next_curve = curve + 1 < curves.size() && middle > starts[curve + 1];
      if (move != nullptr && !next_curve) move->to = phase.start - Mm(starts[curve]);
      if (next_curve) ++curve;
      items.emplace_back(PlannedMove{.segment = {.curve = curves[curve]}, .phases = {}, .to = curves[curve].length()});
      move = &std::get<PlannedMove>(items.back());
      const auto cut = std::upper_bound(cuts.begin(), cuts.end(), middle);
      part_end = cut != cuts.end() ? *cut : 2 * end;
    }
    Phase own = phase;
    own.start = Mm(std::max(0.0, phase.start.value() - starts[curve]));
    move->add(own);
  }
  return items;
}

}  // namespace passo::test
