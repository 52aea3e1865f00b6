// A machine file and the settings of the board: a file of another machine is noticed, and may be refused.
#include "passo/sender/grbl_match.hpp"

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <gmock/gmock.h>

#include "passo/sender/grbl_machine_session.hpp"

namespace passo::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const char* const one_move = "G21 G90\nG1 X-1 F600\nM2\n";

// A file with the settings of the board: 250 steps/mm, 3000 mm/min, and 200 mm below the switches.
MachineDescription fitting_router() {
  MachineDescription machine = strict_router(example_machine("router"));
  for (AxisDescription& axis : machine.axes) {
    axis.steps_per_unit = 250;
    axis.travel_high = 0;
    axis.home.reset();
  }
  machine.homing.clear();
  return machine;
}

AxisDescription& axis_in(MachineDescription& machine, Axis axis) {
  return *std::ranges::find(machine.axes, axis, &AxisDescription::axis);
}

struct GrblMatches : testing::Test {
  // Switches on a board that homes, with or without soft limits.
  void connect(const MachineDescription& machine, bool has_soft_limits) {
    run.emplace(machine, [&](StrictGrbl& grbl) {
      grbl.put(22, 1);
      grbl.put(20, has_soft_limits ? 1 : 0);
    });
    run->description = machine;
    ASSERT_TRUE(run->go_online());
    ASSERT_TRUE(run->ask_and_wait(request::Home{}));
  }
  Sentence warning() const { return run->session.match().warning.value_or(Sentence{}); }
  std::optional<GrblSessionRun> run;
};

TEST_F(GrblMatches, a_file_of_the_board_is_not_objected_to) {
  connect(fitting_router(), true);
  EXPECT_EQ(warning(), Sentence{});
  EXPECT_EQ(run->session.status().trouble_sentence, Sentence{});
  const auto done = run->ask_and_wait(grbl_start("G21 G90\nG53 G0 X-5\nM2\n"));
  ASSERT_TRUE(done) << run->refusal->message();
  EXPECT_EQ(done->outcome, Outcome::done);
}

TEST_F(GrblMatches, another_kinematics_is_a_warning) {
  MachineDescription machine = fitting_router();
  machine.is_core_xy = true;
  connect(machine, true);
  EXPECT_THAT(warning().text, HasSubstr("the board is not built for a CoreXY"));
}

TEST_F(GrblMatches, a_smaller_travel_and_lower_speeds_suit_the_board) {
  MachineDescription machine = fitting_router();
  for (AxisDescription& axis : machine.axes) {
    axis.travel_low = -50;
    axis.velocity = MmPerSecond(20);
  }
  connect(machine, true);
  EXPECT_EQ(warning(), Sentence{});
}

TEST_F(GrblMatches, other_steps_and_faster_rates_are_a_warning_with_both_values) {
  MachineDescription machine = fitting_router();
  axis_in(machine, Axis::x).steps_per_unit = 400;
  axis_in(machine, Axis::y).velocity = MmPerSecond(100);
  connect(machine, true);
  EXPECT_EQ(warning().code, "grbl.other-machine");
  EXPECT_THAT(warning().text, AllOf(HasSubstr("X has 400 steps per mm in the file and $100=250 on the board"),
                                    HasSubstr("Y moves at up to 6000 mm/min in the file and $111=3000 on the board"),
                                    HasSubstr("passo machine --from"), Not(HasSubstr("Z"))));
  EXPECT_EQ(run->session.status().trouble_sentence, warning()) << "the page shows it";
  const auto done = run->ask_and_wait(grbl_start("G21 G90\nG53 G0 X-5\nM2\n"));
  ASSERT_TRUE(done) << "it is only a warning";
}

// Such a file raises the tool to Z60 before it goes to a line.
TEST_F(GrblMatches, a_travel_above_that_of_the_board_is_refused_where_soft_limits_are_on) {
  MachineDescription machine = fitting_router();
  axis_in(machine, Axis::z).travel_low = 0;
  axis_in(machine, Axis::z).travel_high = 60;
  for (const bool has_soft_limits : {true, false}) {
    SCOPED_TRACE(has_soft_limits);
    connect(machine, has_soft_limits);
    EXPECT_THAT(warning().text, HasSubstr("Z goes from 0 to 60 in the file and from -200 to 0 on the board ($132)"));
    const auto ticket = run->ask(grbl_start(one_move));
    EXPECT_EQ(ticket.has_value(), !has_soft_limits);
    if (ticket) {
      run->play([&] { return run->answer_to(*ticket).has_value(); });
      continue;
    }
    EXPECT_EQ(run->refusal->arguments.back().second, "grbl.outside-travel");
    EXPECT_THAT(run->refusal->message(), HasSubstr("soft limits are on ($20=1): Z goes from 0 to 60"));
    // It can be jogged, as far as the board allows.
    EXPECT_TRUE(run->ask_and_wait(request::Jog{
        .way = {.direction = Point{{{-1, 0, 0}}}, .speed = MmPerSecond(20), .distance = Mm(1)}, .lease = Seconds(5)}));
  }
}

TEST(GrblMatch, an_axis_that_homes_to_its_other_end_is_named) {
  MachineDescription machine = fitting_router();
  axis_in(machine, Axis::y).home = HomeDescription{.toward_high = true};
  GrblMachine board;
  for (const char* line : {"$22=1", "$23=2", "$131=200"}) board.hear(line);
  const GrblMatch match = match_with_board(machine, board);
  ASSERT_TRUE(match.warning);
  EXPECT_THAT(match.warning->text,
              HasSubstr("Y homes to its high end in the file and to its low end on the board ($23=2)"));
}

// Without homing the zero may be anywhere, and a board with this option has it at the low end.
TEST(GrblMatch, knows_where_the_board_has_its_zero) {
  MachineDescription machine = fitting_router();
  for (AxisDescription& axis : machine.axes) {
    axis.travel_low = 0;
    axis.travel_high = 200;
  }
  const auto matches = [&](const std::vector<std::string>& told) {
    GrblMachine board;
    for (const std::string& line : told) board.hear(line);
    for (const char* line : {"$130=200", "$131=200", "$132=200"}) board.hear(line);
    return !match_with_board(machine, board).warning;
  };
  EXPECT_TRUE(matches({"$22=0"}));
  EXPECT_FALSE(matches({"$22=1", "$23=7"}));
  EXPECT_TRUE(matches({"[OPT:VZ,15,128]", "$22=1", "$23=7"}));
  EXPECT_FALSE(matches({"[OPT:VZ,15,128]", "$22=1", "$23=0"}));
}

}  // namespace
}  // namespace passo::test
