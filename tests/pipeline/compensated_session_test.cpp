// A machine session with screws that have backlash and errors of pitch: after homing, jogs, stops and probe moves the
// slides stand where the session says.
#include <cmath>
#include <string>
#include <utility>

#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

namespace passo {
namespace {

using test::SessionOn;
using test::SessionRun;
using test::start_of;
using test::xyz;

MachineDescription worn_router() {
  MachineDescription machine = test::short_router();
  for (AxisDescription& axis : machine.axes) {
    axis.screw = {.backlash = 0.15,
                  .errors = {{.at = -40, .off = 0}, {.at = 0, .off = 0.012}, {.at = 40, .off = -0.004}}};
  }
  return machine;
}

// The slides stand where the session says, to the step. `beside`: a constant offset, in steps.
void expect_true_place(SessionRun& run, double beside = 0) {
  const KnownPosition position = run.session().status().position;
  const Truth truth = run.plant().truth_at(run.now());
  for (std::size_t m = 0; m < run.description().axes.size(); ++m) {
    const AxisDescription& axis = run.description().axes[m];
    const double scale = axis.inverted ? -axis.steps_per_unit : axis.steps_per_unit;
    EXPECT_NEAR(truth.positions[m], position.place[axis.axis] * scale, 0.51 + beside) << "motor " << m;
  }
}

class WornMachine : public testing::TestWithParam<bool> {
 protected:
  static request::Jog jog(const Point& direction, double distance) {
    return {.way = {.direction = direction, .speed = MmPerSecond(10), .distance = Mm(distance)}, .lease = Seconds(9)};
  }
  static void done(SessionRun& run, Request wanted, double beside = 0) {
    const Ticket ticket = run.taken(std::move(wanted));
    run.to_end();
    EXPECT_EQ(run.outcome(ticket), Outcome::done);
    expect_true_place(run, beside);
  }
};
INSTANTIATE_TEST_SUITE_P(, WornMachine, testing::Bool(),
                         [](const auto& line) { return std::string(line.param ? "over_a_line" : "direct"); });

TEST_P(WornMachine, stands_where_homing_says) {
  SessionRun run(
      worn_router(),
      {.line = GetParam(), .start = {.place = Point(), .trust = Trust::unknown}, .stands_at = xyz(3, -2, -1)});
  run.make_ready();
  constexpr double found = 1;  // a switch is found at the first step at or behind it
  done(run, request::Home{}, found);
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
  done(run, jog(xyz(1, 1, -1), 5), found);
  done(run, start_of("G21 G53 G0 X3 Y-4\nG1 X-2 Y6 F900\nX-5 Y2\nM2\n"), found);
}

TEST_P(WornMachine, stands_where_a_jog_ends_whichever_way_it_went) {
  SessionRun run(worn_router(), {.line = GetParam()});
  run.make_ready();
  for (const double way : {-1.0, -1.0, 1.0, -1.0, 1.0, 1.0}) done(run, jog(xyz(way, -way), 0.5));
}

TEST_P(WornMachine, knows_the_side_of_its_backlash_when_a_jog_was_stopped) {
  for (const double after : {0.3, 0.55, 0.8}) {
    SessionRun run(worn_router(), {.line = GetParam()});
    run.make_ready();
    for (const double way : {-1.0, 1.0, -1.0, -1.0}) {
      run.taken(jog(xyz(way, -way), 20));
      run.pass(Seconds(after));
      run.taken(request::Stop{});
      run.to_end();
      expect_true_place(run);
    }
    const Point place = run.session().status().position.place;
    run.taken(request::SetPosition{.position = {.place = place, .trust = Trust::commanded}});
    done(run, jog(xyz(1, 1), 3));
    done(run, start_of("G21 G53 G0 X0 Y0\nM2\n"));
  }
}

TEST_P(WornMachine, finds_the_true_place_of_a_contact) {
  SessionOn on{.line = GetParam()};
  std::get<TouchBox>(on.touchables.emplace_back()).ranges[Axis::z].high = -3.2;
  SessionRun run(worn_router(), on);
  run.make_ready();
  for (int again = 0; again < 2; ++again) {
    done(run, request::Probe{.target = xyz(0, 0, -20), .speed = MmPerSecond(2)});
    double contact = 0;
    for (const MachineChange& change : run.changes) {
      if (change.kind == MachineChange::Kind::probed) contact = change.probe->contact[Axis::z];
    }
    EXPECT_NEAR(contact, -3.2, 1.01 / run.description().axes[2].steps_per_unit);
    done(run, jog(xyz(0.2, 0, 1), 3));
  }
}

}  // namespace
}  // namespace passo
