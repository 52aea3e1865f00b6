// Jogging: as long as the lease, within the travel, and with every step counted.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "kit/random_point.hpp"
#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::example_machine;
using test::SessionRun;

Point jog(SessionRun& run, const request::Jog& wanted, bool renews = false) {
  run.taken(wanted);
  while (run.session().busy()) {
    if (renews) run.taken(request::RenewKeepAlive{});
    run.poll(Seconds(0.005));
  }
  EXPECT_EQ(run.state(), MachineState::idle);
  return run.session().status().position.place;
}

double time_of_last_step(const SessionRun& run) {
  const MachineCounts counts = run.board().counts();
  std::int64_t last = 0;
  for (const MotorCounts& motor : counts.motors) last = std::max(last, motor.last_step.count);
  return static_cast<double>(last) / run.description().board.clock.value();
}

class Jog : public testing::TestWithParam<bool> {
 protected:
  test::SessionOn on() const { return {.line = GetParam()}; }
  // Where the machine stands when nobody knows a fraction of a step.
  static constexpr double within = 1e-3;
};
INSTANTIATE_TEST_SUITE_P(, Jog, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

TEST_P(Jog, by_a_distance_goes_just_so_far) {
  SessionRun run(example_machine("router"), on());
  run.make_ready();
  const Point place = jog(
      run, {.way = {.direction = test::xyz(3, 4), .speed = MmPerSecond(20), .distance = Mm(10)}, .lease = Seconds(10)});
  EXPECT_NEAR(place[Axis::x], 6, within);
  EXPECT_NEAR(place[Axis::y], 8, within);
  run.expect_at_place();
}

TEST_P(Jog, goes_at_a_share_of_its_speed_that_a_renewal_changes) {
  SessionRun run(example_machine("router"), on());
  run.make_ready();
  run.taken(request::Jog{
      .way = {.direction = test::xyz(1, 0), .speed = MmPerSecond(40)}, .lease = Seconds(10), .share = 0.25});
  const auto steps_within = [&](Seconds time) {
    const std::int64_t before = run.steps_made();
    run.pass(time);
    return static_cast<double>(run.steps_made() - before);
  };
  run.pass(Seconds(0.5));
  const double slow = steps_within(Seconds(1));
  run.taken(request::RenewKeepAlive{.share = 1});
  run.pass(Seconds(0.5));
  EXPECT_NEAR(steps_within(Seconds(1)) / slow, 4, 0.3);
  EXPECT_EQ(run.refusal_of(request::RenewKeepAlive{.share = 0.01}), "machine.bad-value");
  run.taken(request::Stop{});
  EXPECT_TRUE(run.turn_until(MachineState::idle));
}

TEST_P(Jog, ends_at_the_travel_at_rest_however_long_it_is_renewed) {
  test::SessionOn from = on();
  from.start.place = from.stands_at = test::xyz(0, 290);
  SessionRun run(example_machine("router"), from);
  run.make_ready();
  const Point place = jog(run, {.way = {.direction = test::xyz(1, 1), .speed = MmPerSecond(500)}}, true);
  EXPECT_NEAR(place[Axis::y], 300, within);
  EXPECT_NEAR(place[Axis::x], 10, within);
  run.expect_at_place();
}

TEST_P(Jog, that_is_not_renewed_brakes_at_the_end_of_its_lease_at_the_latest) {
  for (const bool jerk : {false, true}) {
    SCOPED_TRACE(jerk);
    const MachineDescription router = example_machine("router");
    SessionRun run(jerk ? test::with_jerk_limits(router) : router, on());
    run.make_ready();
    const Seconds begun = run.now();
    const Ticket ticket = run.taken(
        request::Jog{.way = {.direction = test::xyz(-1, 0), .speed = MmPerSecond(40)}, .lease = Seconds(0.2)});
    run.to_end();
    // With jerk the deceleration rises and falls for 20 ms each; the lease ends where braking begins all the same.
    const double braking = 40.0 / 800 + (jerk ? 0.02 + 1e-3 : 0);
    const double took = time_of_last_step(run) - begun.value();
    EXPECT_LE(took, 0.2 + braking + 1e-3);
    EXPECT_GE(took, 0.2 - 0.02);
    EXPECT_EQ(run.outcome(ticket), Outcome::stopped);
    run.expect_at_place();
  }
}

TEST_P(Jog, with_random_renewals_never_outlives_its_lease_nor_leaves_the_travel) {
  test::Random random;
  for (const char* name : {"bench", "router", "pantograph", "forty-eight"}) {
    SCOPED_TRACE(name);
    const MachineDescription description = example_machine(name);
    SessionRun run(description, on());
    run.make_ready();
    for (int i = 0; i < (GetParam() ? 25 : 100); ++i) {
      Point direction = test::random_point(random, 1);
      if (random.chance(0.5)) direction[Axis::z] = 0;
      const double lease = random.between(0.1, 0.5);
      run.taken(request::Jog{.way = {.direction = direction,
                                     .speed = MmPerSecond(random.between(1, 120)),
                                     .distance = random.chance(0.3) ? Mm(random.between(0.01, 20)) : Mm(0)},
                             .lease = Seconds(lease)});
      double renewed = run.now().value();
      bool holds = true;
      while (run.session().busy()) {
        run.poll(Seconds(0.005));
        holds = holds && random.chance(0.97);
        if (!holds || !run.session().busy()) continue;
        run.taken(request::RenewKeepAlive{});
        renewed = run.now().value();
      }
      // The slowest of the axes brakes with 30 mm/s².
      double braking = 0;
      for (const AxisDescription& axis : description.axes)
        braking = std::max(braking, axis.velocity / axis.acceleration / Seconds(1));
      EXPECT_LE(time_of_last_step(run), renewed + lease + braking + 1e-3);
      const Point place = run.session().status().position.place;
      for (const AxisDescription& axis : description.axes) {
        EXPECT_GE(place[axis.axis], axis.travel_low - Jog::within);
        EXPECT_LE(place[axis.axis], axis.travel_high + Jog::within);
      }
      run.expect_at_place();
    }
  }
}

TEST_P(Jog, without_a_known_place_goes_anywhere_but_no_further_than_the_travel_is_long) {
  test::SessionOn lost = on();
  lost.start = {.place = test::xyz(35, 0), .trust = Trust::unknown};
  SessionRun run(test::short_router(), lost);
  run.make_ready();
  const Point place = jog(run, {.way = {.direction = test::xyz(1, 0), .speed = MmPerSecond(60)}}, true);
  EXPECT_NEAR(place[Axis::x], 115, within);
  EXPECT_EQ(run.session().status().position.trust, Trust::unknown);
}

TEST_P(Jog, is_not_slowed_by_the_overrides_of_programs) {
  SessionRun run(example_machine("router"), on());
  run.make_ready();
  run.taken(request::Override{.feed = 0.0});
  const Point place = jog(
      run, {.way = {.direction = test::xyz(1, 0), .speed = MmPerSecond(20), .distance = Mm(10)}, .lease = Seconds(10)});
  EXPECT_NEAR(place[Axis::x], 10, within);
}

// A person at a page, or somebody whose network is cut: the jog is renewed, and other things are asked meanwhile, until
// it is let go or nobody renews it any more.
class JogStories : public Jog {};
INSTANTIATE_TEST_SUITE_P(, JogStories, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

TEST_P(JogStories, end_at_rest_within_0_3_s) {
  const char* const given = std::getenv("PASSO_RUNS");
  const int stories = given != nullptr ? std::atoi(given) : 100;
  test::Random random;
  SessionRun run(example_machine("router"), on());
  run.make_ready();
  const auto asked = [&](Request what) { static_cast<void>(run.ask(std::move(what)).has_value()); };
  for (int story = 0; story < stories; ++story) {
    const auto direction = [&] { return test::random_point(random, 1); };
    const auto wanted = [&] {
      return request::Jog{.way = {.direction = direction(),
                                  .speed = MmPerSecond(random.between(1, 25)),
                                  .distance = random.chance(0.2) ? Mm(random.between(0.01, 20)) : Mm(0)}};
    };
    run.taken(wanted());
    const auto disturb = [&] {
      switch (static_cast<int>(random.between(0, 6))) {
        case 0: return asked(wanted());
        case 1: return asked(request::Override{.feed = random.between(0, 2)});
        case 2: return asked(request::Resume{});
        case 3: return asked(request::OperatorDone{});
        case 4: return asked(request::SetPosition{});
        default: return asked(test::start_of("G0 X1\nM2\n"));
      }
    };
    for (double held = random.between(0, 0.6); held > 0 && run.session().busy(); held -= 0.02) {
      run.pass(Seconds(0.02));
      if (random.chance(0.3)) asked(request::RenewKeepAlive{});
      if (run.session().busy() && random.chance(0.2)) disturb();
    }
    // Let go, held by the red button, or silent.
    const Seconds let_go = run.now();
    const int how = static_cast<int>(random.between(0, 3));
    if (how == 0) asked(request::Stop{});
    if (how == 1) asked(request::Hold{});
    for (bool late = false; run.session().busy() && run.now() - let_go < Seconds(2); late = true) {
      run.pass(Seconds(0.02));
      if (how < 2 && late) asked(request::RenewKeepAlive{});  // a renewal that comes late wakes nothing
    }
    ASSERT_FALSE(run.session().busy()) << story;
    EXPECT_LE(time_of_last_step(run), let_go.value() + 0.3) << story;
    if (how != 0) run.to_end();
    run.expect_at_place();
  }
}

}  // namespace
}  // namespace passo
