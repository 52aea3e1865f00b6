// Moves with limited jerk: the count of steps is exact and the result keeps the limits, wherever the move is turned.
#include "passo/ramp/s_curve_move.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "kit/seed.hpp"

namespace passo {
namespace {

constexpr int turn = 200;
const double alpha = 2 * std::numbers::pi / turn;

// Limits in steps and seconds.
SCurveLimits limits_of(double rate, double acceleration, double jerk, double start = 0, double clock = 1e6) {
  return {.setup = {Hertz(clock), turn, {acceleration * alpha}},
          .jerk = {jerk * alpha},
          .rate = Hertz(rate),
          .start = Hertz(start)};
}

struct Played {
  std::vector<std::int64_t> ticks;
  std::vector<double> real;
  std::vector<double> times;  // seconds, of each step from the start
};

Played play(SCurveMove& move, double clock = 1e6) {
  Played played;
  double time = 0;
  while (!move.done()) {
    played.ticks.push_back(move.next().count);
    played.real.push_back(move.real_interval());
    time += move.real_interval() / clock;
    played.times.push_back(time);
  }
  return played;
}

Played play(const SCurveLimits& limits, std::int64_t steps) {
  SCurveMove move(limits);
  move.move_to({steps});
  return play(move, limits.setup.clock.value());
}

TEST(SCurveMove, a_long_move_takes_the_time_of_its_seven_phases) {
  // To reach rate v with acceleration a and jerk j takes the time v/a + a/j, and half of v times the way; cruise
  // between.
  const double v = 5000;
  const double a = 20'000;
  const double j = 400'000;
  const double ramp = v / a + a / j;
  const Played played = play(limits_of(v, a, j), 10'000);
  ASSERT_EQ(played.ticks.size(), 10'000U);
  EXPECT_NEAR(played.times.back(), 2 * ramp + (10'000 - v * ramp) / v, 1e-9);
}

TEST(SCurveMove, short_moves_leave_phases_out_and_take_the_least_time) {
  const double a = 20'000;
  const double j = 400'000;
  // Jerk alone: four phases of t = (s/2j)^⅓.
  EXPECT_NEAR(play(limits_of(5000, a, j), 1).times.back(), 4 * std::cbrt(1 / (2 * j)), 1e-9);
  EXPECT_NEAR(play(limits_of(5000, a, j), 50).times.back(), 4 * std::cbrt(50 / (2 * j)), 1e-9);
  // With constant acceleration between, and no cruise: s = v (v/a + a/j).
  const double s = 800;
  const double v = (-a * a / j + std::sqrt(std::pow(a * a / j, 2) + 4 * a * s)) / 2;
  EXPECT_NEAR(play(limits_of(5000, a, j), 800).times.back(), 2 * (v / a + a / j), 1e-9);
}

TEST(SCurveMove, the_first_steps_come_at_the_cube_root) {
  const Played played = play(limits_of(INFINITY, 1e6, 1e5), 5000);
  for (const int n : {1, 2, 5, 100}) {
    EXPECT_NEAR(played.times[static_cast<std::size_t>(n) - 1] / std::cbrt(6.0 * n / 1e5), 1, 1e-12) << n;
  }
}

TEST(SCurveMove, braking_mirrors_the_start) {
  for (const double start : {0.0, 300.0}) {
    const Played played = play(limits_of(5000, 20'000, 400'000, start), 12'345);
    const std::size_t count = played.real.size();
    ASSERT_EQ(count, 12'345U);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_NEAR(played.real[i] / played.real[count - 1 - i], 1, 1e-7) << start << " " << i;
    }
  }
}

TEST(SCurveMove, the_first_and_last_step_are_inside_the_start_stop_region) {
  for (const std::int64_t steps : {1, 2, 3, 7, 5000}) {
    const Played played = play(limits_of(5000, 20'000, 400'000, 500), steps);
    ASSERT_EQ(played.ticks.size(), static_cast<std::size_t>(steps));
    EXPECT_EQ(played.ticks.front(), 2000);
    EXPECT_NEAR(static_cast<double>(played.ticks.back()), 2000, 1);
    for (const double interval : played.real) EXPECT_LE(interval, 2000.0001);
  }
}

TEST(SCurveMove, a_wanted_rate_inside_the_start_stop_region_is_constant) {
  for (const double start : {250.0, 600.0}) {
    for (const std::int64_t ticks : play(limits_of(250, 20'000, 400'000, start), 40).ticks) EXPECT_EQ(ticks, 4000);
  }
}

TEST(SCurveMove, ticks_are_rounded_from_absolute_times_so_that_nothing_adds_up) {
  const Played played = play(limits_of(333.3, 5000, 50'000, 0, 1000), 100'000);
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < played.ticks.size(); ++i) {
    sum += played.ticks[i];
    ASSERT_NEAR(static_cast<double>(sum), played.times[i] * 1000, 0.5001) << i;
  }
}

// Third differences of the step times show the real rate, acceleration and jerk, without any word of the planner. The
// mean rate between two steps is reached somewhere between them. So two rates whose middles are dt apart differ by at
// most a · dt, and two such accelerations by at most j · dt.
struct LimitCheck {
  const SCurveLimits& limits;
  double start;
  std::vector<double> times = {};
  void check() const {
    const double a = limits.setup.acceleration.value / alpha;
    const double j = limits.jerk.value / alpha;
    const std::size_t first = start > 0 ? 1 : 0;
    for (std::size_t i = first; i + 2 < times.size(); ++i) {
      const double d1 = times[i + 1] - times[i];
      const double d2 = times[i + 2] - times[i + 1];
      ASSERT_LE(1 / d1, std::max(limits.rate.value(), start) * (1 + 1e-9));
      const double change = 2 * (1 / d2 - 1 / d1) / (d1 + d2);
      ASSERT_LE(std::abs(change), a * (1 + 1e-6)) << i;
      if (i + 3 >= times.size()) break;
      const double d3 = times[i + 3] - times[i + 2];
      const double next = 2 * (1 / d3 - 1 / d2) / (d2 + d3);
      // The third divided difference of the position is a mean of the jerk. In it the rounding of the times (times the
      // rate, for positions) is multiplied by eight and divided by the third power of an interval.
      const double noise = 8 * 1e-15 * times[i + 3] / std::pow(std::min({d1, d2, d3}), 4);
      ASSERT_LE(std::abs(next - change) / (d1 + d2 + d3) * 3, j * (1 + 1e-5) + noise) << i;
    }
  }
};

TEST(SCurveMove, stopped_and_turned_at_random_steps_it_keeps_its_limits_and_its_count) {
  std::mt19937_64 random(test::seed());
  const auto between = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
  };
  for (int run = 0; run < 3000; ++run) {
    const double start = random() % 2 == 0 ? 0 : between(20, 500);
    const SCurveLimits limits = limits_of(between(100, 20'000), between(500, 100'000), between(1e4, 1e7), start);
    SCurveMove move(limits);
    std::int64_t position = 0;
    std::int64_t target = static_cast<std::int64_t>(random() % 6000) - 3000;
    bool stopped = false;
    int events = 0;
    move.move_to({target});
    while (!move.done()) {
      // One stretch without a turn.
      LimitCheck check{.limits = limits, .start = start};
      check.times.push_back(0);
      bool up = target > position;
      do {
        const Ticks interval = move.next();
        if (check.times.size() == 1) up = move.up();
        ASSERT_GT(interval.count, 0);
        ASSERT_EQ(up, move.up());
        position += move.up() ? 1 : -1;
        ASSERT_EQ(move.position().count, position);
        check.times.push_back(check.times.back() + move.real_interval() / 1e6);
        if (events < 5 && random() % 200 == 0) {
          ++events;
          stopped = random() % 2 == 0;
          if (stopped) {
            move.stop();
          } else {
            target = static_cast<std::int64_t>(random() % 6000) - 3000;
            move.move_to({target});
          }
        }
      } while (!move.done() && move.rate().value() > 0);
      ASSERT_NO_FATAL_FAILURE(check.check()) << "run " << run;
    }
    if (!stopped) {
      ASSERT_EQ(position, target);
    }
  }
}

TEST(SCurveMove, a_stop_from_full_speed_takes_the_way_of_three_phases) {
  const double v = 5000;
  const double a = 20'000;
  const double j = 400'000;
  SCurveMove move(limits_of(v, a, j));
  move.move_to({100'000});
  for (int i = 0; i < 50'000; ++i) move.next();
  EXPECT_NEAR(move.rate().value(), v, 1e-9);
  EXPECT_NEAR(move.acceleration().value, 0, 1e-9);
  move.stop();
  const Played played = play(move);
  EXPECT_EQ(static_cast<double>(played.ticks.size()), std::ceil(v / 2 * (v / a + a / j)));
  EXPECT_TRUE(move.done());
}

TEST(SCurveMove, a_target_asked_for_twice_changes_nothing) {
  const SCurveLimits limits = limits_of(5000, 20'000, 400'000);
  const Played plain = play(limits, 3000);
  SCurveMove move(limits);
  move.move_to({3000});
  for (const std::int64_t ticks : plain.ticks) {
    ASSERT_EQ(move.next().count, ticks);
    move.move_to({3000});
  }
  EXPECT_TRUE(move.done());
}

}  // namespace
}  // namespace passo
