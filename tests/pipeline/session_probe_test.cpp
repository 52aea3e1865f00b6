// What homing and probe moves leave behind when somebody stops them, and where a probe move may go.
#include <algorithm>
#include <string>
#include <utility>

#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::xyz;

class AfterAProbeMove : public testing::TestWithParam<bool> {
 protected:
  static request::Jog jog(const Point& direction) {
    return {.way = {.direction = direction, .speed = MmPerSecond(10), .distance = Mm(10)}, .lease = Seconds(5)};
  }
  // Begins, and is stopped soon after.
  static void stop_amid(SessionRun& run, Request wanted) {
    const Ticket ticket = run.taken(std::move(wanted));
    run.pass(Seconds(0.5));
    run.taken(request::Stop{});
    run.to_end();
    ASSERT_EQ(run.outcome(ticket), Outcome::stopped);
  }
};
INSTANTIATE_TEST_SUITE_P(, AfterAProbeMove, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

TEST_P(AfterAProbeMove, the_switch_of_a_homing_that_was_stopped_stops_the_motors_again) {
  SessionRun run(test::short_router(), {.line = GetParam()});
  run.make_ready();
  stop_amid(run, request::Home{});
  const auto first = run.description().homing.front();
  const auto homed = std::ranges::find(run.description().axes, first, &AxisDescription::axis);
  const Ticket ticket = run.taken(jog(xyz(1, 0)));
  run.pass(Seconds(0.3));
  run.board().set_switch(static_cast<std::uint16_t>(input_limit << static_cast<unsigned>(homed->home->input)), true);
  run.to_end();
  EXPECT_EQ(run.outcome(ticket), Outcome::failed);
  EXPECT_EQ(run.state(), MachineState::alarm);
}

TEST_P(AfterAProbeMove, a_homing_that_is_stopped_in_its_last_pull_off_claims_no_place) {
  for (const double delay : {0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2}) {
    SCOPED_TRACE(delay);
    SessionRun run(test::short_router(), {.line = GetParam()});
    run.make_ready();
    const Ticket ticket = run.taken(request::Home{});
    const HomingPath& homing = *run.session().homing();
    ASSERT_TRUE(run.turn_until([&] {
      return homing.done() ||
             (homing.homed().size() + 1 == run.description().homing.size() && homing.stage() == HomingStage::pull_off);
    }));
    run.pass(Seconds(delay));
    if (run.session().busy()) run.taken(request::Stop{});
    run.to_end();
    EXPECT_EQ(run.outcome(ticket) == Outcome::done, run.session().status().position.trust == Trust::homed);
    run.expect_at_place();
  }
}

TEST_P(AfterAProbeMove, a_touch_stops_no_jog) {
  test::SessionOn on{.line = GetParam()};
  std::get<TouchBox>(on.touchables.emplace_back()).ranges[Axis::z].high = -5;
  SessionRun run(test::short_router(), on);
  run.make_ready();
  stop_amid(run, request::Probe{.target = xyz(0, 0, -20), .speed = MmPerSecond(2)});
  const Ticket ticket = run.taken(jog(xyz(0, 0, -1)));
  run.to_end();
  EXPECT_EQ(run.outcome(ticket), Outcome::done);
}

TEST_P(AfterAProbeMove, none_goes_out_of_the_travel_of_a_machine_that_knows_its_place) {
  SessionRun run(test::short_router(), {.line = GetParam()});
  run.make_ready();
  const request::Probe far{.target = xyz(0, 0, -41), .speed = MmPerSecond(2)};
  EXPECT_EQ(run.refusal_of(far), "machine.bad-value");
  run.taken(request::SetPosition{.position = {.place = Point(), .trust = Trust::unknown}});
  stop_amid(run, far);
}

}  // namespace
}  // namespace passo
