// Frames, places and the end of a program on a board with Grbl.
#include <algorithm>
#include <string>

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"

#include "passo/activity/framing.hpp"
#include "passo/activity/go_to.hpp"
#include "passo/sender/grbl_machine_session.hpp"

namespace passo::test {
namespace {

MachineDescription parking_router() {
  MachineDescription machine = example_machine("router");
  Point place;
  place[Axis::x] = -20;
  place[Axis::y] = 30;
  machine.park = {.place = place, .at_end = ParkDescription::AtEnd::park};
  return machine;
}

// A frame is a small program for these boards too, and the end of a program is where the machine file says.
TEST(GrblSession, frames_a_job_goes_to_places_and_parks_at_the_end) {
  const MachineDescription machine = parking_router();
  GrblSessionRun run(machine);
  ASSERT_TRUE(run.go_online());
  Point from;
  Point to;
  from[Axis::z] = to[Axis::z] = -3;
  to[Axis::x] = 40;
  to[Axis::y] = 25;
  JobOutline outline;
  outline.add(Segment{.curve = Curve::line(from, to)});
  double highest_y = 0;
  const auto play = [&](const std::string& text) {
    request::Start start = grbl_start(text);
    start.options.dialect = Dialect::linuxcnc;
    const auto ticket = run.ask(std::move(start));
    if (!ticket) return false;
    const bool ends = run.play([&] {
      highest_y = std::max(highest_y, run.grbl.place()[Axis::y]);
      return run.answer_to(*ticket).has_value();
    });
    return ends && run.answer_to(*ticket)->outcome == Outcome::done;
  };
  const auto frame = framing_program(outline, {.clearance = 4}, machine, "job");
  ASSERT_TRUE(frame) << frame.error().text;
  ASSERT_TRUE(play(*frame));
  EXPECT_NEAR(highest_y, 25, 0.5);
  EXPECT_NEAR(run.grbl.place()[Axis::x], 0, 1e-6);
  EXPECT_NEAR(run.grbl.place()[Axis::z], 4, 1e-6) << "no M2: it stays";
  const auto zero = go_to_program(Destination::work_zero, machine, {}, {});
  ASSERT_TRUE(zero && play(*zero));
  EXPECT_NEAR(run.grbl.place()[Axis::z], *machine.top_of_travel(), 0.01);
  ASSERT_TRUE(play("G21 G90\nG1 X10 F1200\nG1 Y10\nM2\n"));
  EXPECT_NEAR(run.grbl.place()[Axis::x], -20, 0.01);
  EXPECT_NEAR(run.grbl.place()[Axis::y], 30, 0.01);
}

}  // namespace
}  // namespace passo::test
