// Computes the exact steps from the phases by bisection in long double, and the steps that a list of board segments
// plays from the definition in board_segment.hpp. This code shares nothing with the step generator or the player.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

#include "passo/stepgen/step_generator.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo::oracle {

struct ExactStep {
  long double time = 0;  // ticks
  int direction = 0;
};

struct PlayedStep {
  std::int64_t tick = 0;
  int direction = 0;
  bool of_master = false;     // a step of the motor that defines the events of its segment
  bool held_back = false;     // the step's event, or the previous event, was as early as the board allows
  std::int64_t interval = 0;  // ticks; the longer of the intervals before and after the step's event
};

struct Playback {
  std::vector<std::vector<PlayedStep>> steps;  // the steps of each motor
  std::vector<std::int64_t> counts;
  std::vector<std::int64_t> event_ticks;
  std::int64_t end_tick = 0;
  std::int64_t segments = 0;
  std::int64_t events = 0;
  std::int64_t shortest_interval = INT64_MAX;  // ticks
};

// Position = start + first s + second s² + third s³.
struct Cubic {
  long double first, second, third;
};
inline Cubic cubic_of(const MotorRow& motor, const Curve& curve) {
  const Curve::CubicData data = curve.cubic_data();
  Cubic sum{0, 0, 0};
  for (const auto& [axis, factor] : motor.steps.shares()) {
    sum.first += static_cast<long double>(factor) * data.first[axis];
    sum.second += static_cast<long double>(factor) * data.second[axis];
    sum.third += static_cast<long double>(factor) * data.third[axis];
  }
  return sum;
}

inline long double exact_coordinate(Axis axis, const Curve& curve, long double s) {
  const long double length = curve.length().value();
  if (curve.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve.arc_data();
    const long double part = s / length;
    const long double angle = arc.start_angle + arc.sweep * part;
    const long double radius = arc.start_radius + (static_cast<long double>(arc.end_radius) - arc.start_radius) * part;
    if (axis == arc.first) return arc.first_center + radius * std::cos(angle);
    if (axis == arc.second) return arc.second_center + radius * std::sin(angle);
  }
  const long double start = curve.start()[axis];
  if (curve.shape() == Curve::Shape::cubic && s < length) {  // at s = length, the curve's given end is exact
    const Curve::CubicData data = curve.cubic_data();
    return start + s * (data.first[axis] + s * (data.second[axis] + s * data.third[axis]));
  }
  return start + (curve.end()[axis] - start) * s / length;
}

// Returns the exact position of a motor; its step count is this value rounded down.
inline long double exact_place(const MotorRow& motor, const Curve& curve, long double s) {
  long double steps = 0.5L;
  for (const auto& [axis, factor] : motor.steps.shares()) steps += factor * exact_coordinate(axis, curve, s);
  return steps;
}

inline long double bisect(auto&& below, long double low, long double high) {
  for (int i = 0; i < 70; ++i) {
    const long double middle = (low + high) / 2;
    (below(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Returns the seconds from the start of the move until the path reaches s.
inline long double exact_time(const PlannedMove& move, long double s) {
  long double time = 0;
  for (std::size_t i = 0; i < move.phase_count; ++i) {
    const Phase& phase = move.phases[i];
    const long double v = phase.velocity.value();
    const long double a = phase.acceleration.value();
    const long double j = phase.jerk.value();
    const auto position = [&](long double t) { return phase.start.value() + t * (v + t * (a / 2 + t * j / 6)); };
    const long double duration = phase.duration.value();
    if (i + 1 < move.phase_count && position(duration) < s) {
      time += duration;
      continue;
    }
    return time + bisect([&](long double t) { return position(t) < s; }, 0, duration);
  }
  return time;
}

// Returns the positions at which a motor of an axis in the arc's plane reverses. Between two samples, the slope changes
// its sign at most once.
inline std::vector<long double> turns_on_arc(const MotorRow& motor, const Curve& curve) {
  const Curve::ArcData& arc = curve.arc_data();
  const long double length = curve.length().value();
  const long double turn = arc.sweep / length;
  const long double growth = (static_cast<long double>(arc.end_radius) - arc.start_radius) / length;
  const auto rises = [&](long double s) {
    const long double angle = arc.start_angle + turn * s;
    const long double around = (arc.start_radius + growth * s) * turn;
    long double slope = 0;
    for (const auto& [axis, factor] : motor.steps.shares()) {
      slope += factor * (axis == arc.first ? growth * std::cos(angle) - around * std::sin(angle)
                         : axis == arc.second
                             ? growth * std::sin(angle) + around * std::cos(angle)
                             : (static_cast<long double>(curve.end()[axis]) - curve.start()[axis]) / length);
    }
    return slope > 0;
  };
  const int samples = 64 + static_cast<int>(std::fabs(arc.sweep) * 64);
  std::vector<long double> turns;
  for (int i = 0; i < samples; ++i) {
    const long double low = length * i / samples;
    const long double high = length * (i + 1) / samples;
    const bool rose = rises(low);
    if (rises(high) != rose) turns.push_back(bisect([&](long double s) { return rises(s) == rose; }, low, high));
  }
  return turns;
}

// Returns the positions where the slope of a cubic changes its sign, by bisection on both sides of the slope's own
// extremum.
inline std::vector<long double> turns_on_cubic(const MotorRow& motor, const Curve& curve) {
  const auto [first, second, third] = cubic_of(motor, curve);
  const auto slope = [&, a = first, b = second, c = third](long double s) { return a + s * (2 * b + s * 3 * c); };
  const long double length = curve.length().value();
  const long double vertex = third != 0 ? std::clamp(-second / (3 * third), 0.0L, length) : length;
  std::vector<long double> turns;
  for (const auto& [low, high] : {std::pair{0.0L, vertex}, std::pair{vertex, length}}) {
    const bool falls = slope(low) > 0;
    if ((slope(high) > 0) == falls || low == high) continue;
    turns.push_back(bisect([&](long double s) { return (slope(s) > 0) == falls; }, low, high));
  }
  return turns;
}

// Returns values of s between which the motor does not reverse. They cover the part of the curve that the move covers.
inline std::vector<long double> monotone_pieces(const MotorRow& motor, const PlannedMove& move) {
  const Curve& curve = move.segment.curve;
  const Curve::ArcData& arc = curve.arc_data();
  std::vector<long double> turns;
  if (curve.shape() == Curve::Shape::cubic) turns = turns_on_cubic(motor, curve);
  const bool turns_round = motor.steps.factor_of(arc.first) != 0 || motor.steps.factor_of(arc.second) != 0;
  if (curve.shape() == Curve::Shape::arc && turns_round) turns = turns_on_arc(motor, curve);
  const long double from = move.phases[0].start.value();
  const long double to = move.to.value();
  std::vector<long double> ends = {from};
  for (const long double turn : turns) {
    if (turn > from && turn < to) ends.push_back(turn);
  }
  ends.push_back(to);
  return ends;
}

inline std::int64_t whole_place(long double place) {
  return static_cast<std::int64_t>(std::floor(place));
}

inline std::vector<ExactStep> exact_steps(const std::vector<MotionItem>& items, const StepOptions& options,
                                          unsigned m) {
  std::vector<ExactStep> steps;
  const MotorRow& motor = options.kinematics.rows()[m];
  const long double ticks = options.clock.tick_rate.value();
  long double start = 0;              // seconds
  std::optional<std::int64_t> count;  // the motor's current step count
  for (const MotionItem& item : items) {
    if (const auto* action = std::get_if<Action>(&item)) {
      start += action->dwell.value();
      continue;
    }
    const auto& move = std::get<PlannedMove>(item);
    const Curve& curve = move.segment.curve;
    const std::vector<long double> pieces = monotone_pieces(motor, move);
    if (!count) count = whole_place(exact_place(motor, curve, pieces.front()));
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const bool rises = exact_place(motor, curve, pieces[i + 1]) > exact_place(motor, curve, pieces[i]);
      const std::int64_t last = whole_place(exact_place(motor, curve, pieces[i + 1]));
      // The count is carried over from move to move, so that a grid line on which two moves meet is crossed only once.
      for (; rises ? *count < last : *count > last; *count += rises ? 1 : -1) {
        const auto line = static_cast<long double>(rises ? *count + 1 : *count);
        const long double s = bisect([&](long double at) { return (exact_place(motor, curve, at) < line) == rises; },
                                     pieces[i], pieces[i + 1]);
        steps.push_back({.time = (start + exact_time(move, s)) * ticks, .direction = rises ? 1 : -1});
      }
    }
    for (const Phase& phase : move) start += phase.duration.value();
  }
  return steps;
}

// Returns whether the board may omit two steps: the path crosses a grid line and returns before the next event.
inline bool may_be_left_out(const ExactStep& there, const ExactStep& back,
                            const std::vector<std::int64_t>& event_ticks) {
  const auto event_after = [&](const ExactStep& step) {
    return std::lower_bound(event_ticks.begin(), event_ticks.end(), step.time - 1,
                            [](std::int64_t tick, long double time) { return static_cast<long double>(tick) < time; });
  };
  return there.direction != back.direction && event_after(back) - event_after(there) <= 1;
}

// Returns the signed increment, as in the table of board_segment.hpp.
inline std::int64_t signed_increment(const BoardSegment& segment, unsigned m) {
  const bool flip = (segment.flips >> m & 1U) != 0;
  const bool down = (segment.directions >> m & 1U) != 0;
  const std::int64_t raw = segment.increments[m];
  if (!down) return flip ? 65536 : raw;
  return flip ? raw - 65536 : 0;
}

// Returns the intervals in 1/65536 tick.
inline std::vector<std::int64_t> intervals_of(const BoardSegment& segment) {
  std::vector<std::int64_t> intervals;
  for_each_part(segment, [&](const PartTimes& part, unsigned events, unsigned /*before*/) {
    for (unsigned k = 0; k < events; ++k) intervals.push_back(part.interval + k * std::int64_t{part.change});
  });
  return intervals;
}

// Returns the items with roots and bends resolved, as the board plays them.
inline std::vector<BoardItem> plain(const std::vector<BoardItem>& items) {
  std::vector<BoardItem> parts;
  for (const BoardItem& item : items) {
    const auto* segment = std::get_if<BoardSegment>(&item);
    if (segment == nullptr) {
      parts.push_back(item);
    } else {
      for_each_plain_part(*segment, [&](const BoardSegment& part) { parts.emplace_back(part); });
    }
  }
  return parts;
}

inline Playback play(const std::vector<BoardItem>& items, const StepOptions& options) {
  Playback result;
  result.steps.resize(options.kinematics.motor_count());
  std::vector<std::int64_t> place(options.kinematics.motor_count(), 32768);
  std::int64_t time = 32768;  // 1/65536 tick
  struct Pending {
    unsigned motor;
    std::size_t index;
  };
  std::vector<Pending> pending;  // steps whose next interval is not known yet
  // Events without any motion only fill a time that is too long for one interval, so the interval includes them. At an
  // action the machine is stopped, and the interval ends.
  std::int64_t last_motion = 0;  // ticks
  const auto end_interval = [&](std::int64_t tick) {
    for (const Pending& p : pending) {
      PlayedStep& step = result.steps[p.motor][p.index];
      step.interval = std::max(step.interval, tick - last_motion);
    }
    pending.clear();
    return tick - std::exchange(last_motion, tick);
  };
  bool held_back = false;
  const double shortest = options.clock.tick_rate / options.clock.highest_event_rate;
  for (const BoardItem& item : plain(items)) {
    const auto* segment = std::get_if<BoardSegment>(&item);
    if (segment == nullptr) {
      end_interval(time >> 16);
      continue;
    }
    ++result.segments;
    // The master moves by a power of two, and more than any other motor. If two motors move equally, this code cannot
    // determine which one is the master.
    std::int64_t most = 0;
    unsigned alike = 0;
    for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
      const std::int64_t increment = std::abs(signed_increment(*segment, m));
      alike = increment == most ? alike + 1 : increment > most ? 1 : alike;
      most = std::max(most, increment);
    }
    const bool has_master = alike == 1 && (most & (most - 1)) == 0 && segment->events > 2;
    for (const std::int64_t interval : intervals_of(*segment)) {
      const std::int64_t before = time >> 16;
      time += interval;
      const std::int64_t tick = time >> 16;
      const bool was_held_back = held_back;
      held_back = static_cast<double>(tick - before) <= shortest + 1;
      ++result.events;
      result.event_ticks.push_back(tick);
      result.shortest_interval = std::min(result.shortest_interval, tick - before);
      if (most == 0) continue;
      const std::int64_t since_motion = end_interval(tick);
      for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
        const std::int64_t increment = signed_increment(*segment, m);
        const std::int64_t whole = place[m] >> 16;
        place[m] += increment;
        const std::int64_t steps = (place[m] >> 16) - whole;
        if (steps == 0) continue;
        pending.push_back({.motor = m, .index = result.steps[m].size()});
        result.steps[m].push_back({.tick = tick,
                                   .direction = steps > 0 ? 1 : -1,
                                   .of_master = has_master && std::abs(increment) == most,
                                   .held_back = held_back || was_held_back,
                                   .interval = since_motion});
      }
    }
  }
  for (const std::int64_t p : place) result.counts.push_back(p >> 16);
  result.end_tick = time >> 16;
  return result;
}

inline std::vector<BoardItem> generate(const std::vector<MotionItem>& items, const StepOptions& options) {
  test::ListSource<MotionItem> source(items);
  StepGenerator generator(source, options);
  return test::drain(generator);
}

// Checks every step of every motor: the right number of steps, in the right direction, at the right time.
inline void expect_exact(const std::vector<MotionItem>& items, const StepOptions& options) {
  const std::vector<BoardItem> board = generate(items, options);
  const Playback played = play(board, options);
  const double shortest = options.clock.tick_rate / options.clock.highest_event_rate;
  EXPECT_GE(static_cast<double>(played.shortest_interval) + 1, shortest);
  for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
    const std::vector<ExactStep> exact = exact_steps(items, options, m);
    const std::vector<PlayedStep>& steps = played.steps[m];
    const auto left_out = [&](std::size_t i) {
      return i + 1 < exact.size() && may_be_left_out(exact[i], exact[i + 1], played.event_ticks);
    };
    std::size_t i = 0;
    for (const PlayedStep& step : steps) {
      const auto interval = static_cast<long double>(step.interval);
      const long double allowed = step.held_back ? interval + shortest + 1 : step.of_master ? 1 : interval + 1;
      const auto error = [&] { return std::fabs(static_cast<long double>(step.tick) - exact[i].time); };
      while (left_out(i) && (exact[i].direction != step.direction || error() > allowed)) i += 2;
      ASSERT_LT(i, exact.size()) << "motor " << m << ": a step too many at tick " << step.tick;
      ASSERT_EQ(step.direction, exact[i].direction) << "motor " << m << " step " << i << " at tick " << step.tick;
      ASSERT_LE(error(), allowed) << "motor " << m << " step " << i << " at tick " << step.tick << " of "
                                  << exact[i].time << (step.of_master ? " (master)" : "");
      ++i;
    }
    while (left_out(i)) i += 2;
    ASSERT_EQ(i, exact.size()) << "motor " << m << ": steps are missing";
  }
}

}  // namespace passo::oracle
