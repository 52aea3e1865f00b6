// The earliest stop that a search finds on the path, within the limits of all axes together: the machine could come to
// rest in that time. test::least_rest_after() is below the least possible time, this is above it. Shares no code with
// the planner.
//
// The search uses equal time steps. In each step the acceleration along the path changes linearly, to one of a few
// values between the least and the greatest that the limits allow. Of the motions at nearly the same position with
// nearly the same speed and acceleration, one is kept, and of these, the ones that seem likely to stop first. A motion
// is at rest after a linear rise of its acceleration to 0.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo::test {

// The segments of a motion, in their order.
class LaidPath {
 public:
  struct Piece {
    Segment segment;
    bool rests_after = false;
  };
  struct Place {
    std::size_t piece = 0;
    double s = 0;
    double speed = 0;
    double acceleration = 0;
  };

  void note(const MotionItem& item) {
    if (const auto* action = std::get_if<Action>(&item)) {
      if (action->kind != Action::Kind::feed_hold && !pieces_.empty()) pieces_.back().rests_after = true;
      return;
    }
    const auto& move = std::get<PlannedMove>(item);
    if (move.phase_count == 0) return;
    if (ended_) {
      if (!pieces_.empty()) pieces_.back().rests_after |= has_corner(pieces_.back().segment, move.segment);
      pieces_.push_back({.segment = move.segment});
    }
    ended_ = move.to >= move.segment.curve.length();
    const Phase& last = move.phases[move.phase_count - 1];
    place_ = {.piece = ended_ ? pieces_.size() : pieces_.size() - 1,
              .s = ended_ ? 0 : move.to.value(),
              .speed = move.exit_velocity().value(),
              .acceleration = last.acceleration_at(last.duration).value()};
  }
  const std::vector<Piece>& pieces() const { return pieces_; }
  // At the end of the last motion.
  const Place& place() const { return place_; }

 private:
  static bool has_corner(const Segment& before, const Segment& after) {
    const Point turn = after.curve.tangent(Mm(0)) - before.curve.tangent(before.curve.length());
    return before.mode == PathMode::exact_stop ||
           std::ranges::any_of(turn.values, [](double part) { return std::abs(part) > 1e-6; });
  }

  std::vector<Piece> pieces_;
  Place place_;
  bool ended_ = true;
};

class SoonestRest {
 public:
  SoonestRest(const std::vector<AxisDescription>& axes, const std::vector<LaidPath::Piece>& pieces)
      : axes_(axes), pieces_(pieces) {}

  // Returns the time of the soonest rest found, at most `most`. Infinite: none was found.
  double time_from(const LaidPath::Place& from, double most) {
    best_ = most * (1 + 1e-9);
    step_ = most / steps;
    states_.assign(1, from);
    fastest_ = (1 + 1e-9) * from.speed;
    way_unit_ = std::max(from.speed * most / 256, 1e-12);
    speed_unit_ = std::max(from.speed / 128, 1e-12);
    force_unit_ = std::max(accelerations(shape_at(from), 0).high / 128, 1e-9);
    bool found = false;
    for (int i = 0; i <= steps && !states_.empty(); ++i) {
      for (const LaidPath::Place& state : states_) found |= try_rest(state, i * step_);
      if (i < steps) go_on(i * step_);
    }
    return found ? best_ : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr int steps = 120;
  // Times the limits of accelerations and jerks: the motion before may use up to 0.999 of them, and needs some room.
  // Where it uses them fully, the time to rest depends on them a lot: with 1.01 here, rests are sooner by up to 1.17
  // times, and with 1.03 by 1.37 times (program 9300000).
  static constexpr double raised = 1.001;
  static constexpr std::size_t most_states = 1500;
  static constexpr std::array shares = {0.0, 0.1, 0.3, 0.6, 1.0};
  static constexpr double most_override = 2;

  // What the axes ask for and allow at a place, along the path.
  struct Room {
    double low = -1e12;
    double high = 1e12;
    void narrow(double slope, double used, double limit) {
      if (std::abs(slope) < 1e-9) {
        if (std::abs(used) > limit) low = high + 1;
        return;
      }
      const double one = (-limit - used) / slope;
      const double other = (limit - used) / slope;
      low = std::max(low, std::min(one, other));
      high = std::min(high, std::max(one, other));
    }
    bool empty() const { return low > high; }
  };
  struct Shape {
    Point first;
    Point second;
    Point third;
  };
  Shape shape_at(const LaidPath::Place& at) const {
    const Curve& curve = pieces_[at.piece].segment.curve;
    const Mm s = std::clamp(Mm(at.s), Mm(0), curve.length());
    return {.first = curve.tangent(s), .second = curve.second_derivative(s), .third = curve.third_derivative(s)};
  }

  // Goes forwards. Returns false at a rest of the path or its end.
  bool pass(LaidPath::Place& place) const {
    while (place.piece < pieces_.size() && place.s > pieces_[place.piece].segment.curve.length().value()) {
      if (pieces_[place.piece].rests_after) return false;
      place.s -= pieces_[place.piece++].segment.curve.length().value();
    }
    return place.piece < pieces_.size();
  }

  Room accelerations(const Shape& shape, double v) const {
    Room room;
    for (const AxisDescription& axis : axes_) {
      const double slope = shape.first[axis.axis];
      if (std::abs(slope) * v > axis.velocity.value() * 1.001) room.low = room.high + 1;
      room.narrow(slope, shape.second[axis.axis] * v * v,
                  raised * axis.acceleration_at(MmPerSecond(std::abs(slope) * v)).value());
    }
    return room;
  }
  Room jerks(const Shape& shape, double v, double a) const {
    Room room;
    for (const AxisDescription& axis : axes_) {
      if (!(axis.jerk.value() > 0)) continue;
      const double used = 3 * shape.second[axis.axis] * v * a + shape.third[axis.axis] * v * v * v;
      room.narrow(shape.first[axis.axis], used, raised * axis.jerk.value());
    }
    return room;
  }
  bool allows(const LaidPath::Place& place, double jerk) const {
    const Shape shape = shape_at(place);
    const Room forces = accelerations(shape, place.speed);
    const Room jolts = jerks(shape, place.speed, place.acceleration);
    const double little = 1e-6 * (std::abs(jerk) + 1);
    const double little_force = 1e-6 * (std::abs(place.acceleration) + 1);
    return place.acceleration >= forces.low - little_force && place.acceleration <= forces.high + little_force &&
           jerk >= jolts.low - little && jerk <= jolts.high + little && !jolts.empty() && !forces.empty();
  }
  // The place after this time with that jerk. Returns false if the path rests before or a limit is exceeded there.
  bool move_on(LaidPath::Place& place, double jerk, double time) const {
    place.s += time * (place.speed + time * (place.acceleration / 2 + time * jerk / 6));
    place.speed += time * (place.acceleration + time * jerk / 2);
    place.acceleration += time * jerk;
    return place.speed >= 0 && pass(place) && place.speed <= fastest_at(place) && allows(place, jerk);
  }
  double fastest_at(const LaidPath::Place& place) const {
    return std::max(fastest_, most_override * pieces_[place.piece].segment.speed.value());
  }

  bool try_rest(const LaidPath::Place& from, double time) {
    const double v = from.speed;
    const double a = from.acceleration;
    if (v < 1e-9 * (1 + fastest_)) return take(time);
    if (!(a < 0)) return false;
    const bool jolts = std::ranges::any_of(axes_, [](const AxisDescription& axis) { return axis.jerk.value() > 0; });
    const double left = (jolts ? 2 : 1) * v / -a;
    if (time + left >= best_) return false;
    const double jerk = jolts ? a * a / (2 * v) : 0;
    constexpr int looks = 8;
    LaidPath::Place place = from;
    for (int i = 0; i < looks; ++i) {
      if (!allows(place, jerk)) return false;
      if (i + 1 < looks && !move_on(place, jerk, left / looks)) return false;
    }
    return take(time + left);
  }
  bool take(double time) {
    if (time >= best_) return false;
    best_ = time;
    return true;
  }

  // The time to rest if the limits stayed as they are here.
  double guess(const LaidPath::Place& place) const {
    const Shape shape = shape_at(place);
    const double strength = std::max(-accelerations(shape, 0).low, 1e-9);
    const double jerk = std::min(std::max(jerks(shape, 0, 0).high, 1e-9), 1e12);
    const double eased = place.speed + place.acceleration * std::abs(place.acceleration) / (2 * jerk);
    const double v =
        std::max(eased, 0.0) + (place.acceleration < 0 ? place.acceleration * place.acceleration / jerk : 0);
    const double whole = v * jerk > strength * strength ? v / strength + strength / jerk : 2 * std::sqrt(v / jerk);
    return whole + place.acceleration / jerk;
  }

  void go_on(double time) {
    std::unordered_map<std::uint64_t, std::pair<double, LaidPath::Place>> next;
    for (const LaidPath::Place& state : states_) {
      const Shape shape = shape_at(state);
      const Room jolts = jerks(shape, state.speed, state.acceleration);
      const Room forces = accelerations(shape, state.speed);
      // The limits at the end of the step, as far as it is known yet.
      LaidPath::Place later = state;
      later.speed = std::max(state.speed + state.acceleration * step_, 0.0);
      later.s += (state.speed + later.speed) / 2 * step_;
      if (!pass(later)) later = state;
      const Shape shape_later = shape_at(later);
      const Room jolts_later = jerks(shape_later, later.speed, state.acceleration);
      const Room forces_later = accelerations(shape_later, later.speed);
      const double low_here = std::max(jolts.low, (forces.low - state.acceleration) / step_);
      const double high_here = std::min(jolts.high, (std::max(forces.high, 0.0) - state.acceleration) / step_);
      const double low = std::max({low_here, jolts_later.low, (forces_later.low - state.acceleration) / step_});
      const double high = std::max(std::min(high_here, jolts_later.high), low);
      if (!(low_here <= high_here)) continue;
      std::array<double, 2 * shares.size()> tried{};
      for (std::size_t i = 0; i < shares.size(); ++i) {
        tried[2 * i] = low + (high - low) * shares[i];
        tried[2 * i + 1] = low_here + (high_here - low_here) * shares[i];
      }
      for (const double jerk : tried) {
        LaidPath::Place half = state;
        LaidPath::Place place = state;
        if (!move_on(half, jerk, step_ / 2) || !move_on(place, jerk, step_)) continue;
        const double rest = guess(place);
        if (time + step_ + 0.5 * rest > best_) continue;
        const std::uint64_t key = key_of(place);
        const auto [at, is_new] = next.try_emplace(key, rest, place);
        if (!is_new && rest < at->second.first) at->second = {rest, place};
      }
    }
    std::vector<std::pair<double, LaidPath::Place>> all;
    for (const auto& one : next) all.push_back(one.second);
    const auto sooner = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (all.size() > most_states) {
      std::ranges::nth_element(all, all.begin() + most_states, sooner);
      all.resize(most_states);
    }
    states_.clear();
    for (const auto& one : all) states_.push_back(one.second);
  }
  std::uint64_t key_of(const LaidPath::Place& place) const {
    const auto bin = [](double value, double unit) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / unit))) & 0xffff;
    };
    return bin(place.s, way_unit_) | bin(place.speed, speed_unit_) << 16 | bin(place.acceleration, force_unit_) << 32 |
           static_cast<std::uint64_t>(place.piece & 0xffff) << 48;
  }

  const std::vector<AxisDescription>& axes_;
  const std::vector<LaidPath::Piece>& pieces_;
  std::vector<LaidPath::Place> states_;
  double best_ = 0;
  double step_ = 0;
  double way_unit_ = 0;
  double speed_unit_ = 0;
  double force_unit_ = 0;
  double fastest_ = 0;
};

}  // namespace passo::test
