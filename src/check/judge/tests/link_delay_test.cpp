#include "passo/judge/link_delay.hpp"

#include "judged_program.hpp"

namespace passo {
namespace {

const std::string bends =
    "G21 G90 G17 G64 P.02 F3000 S1000 M3\nG0 X30 Y0\nG3 X30 Y0 I-30 J0\nG1 X20 Y5 Z-3\nX25 Y9 Z-1\nX0 Y0 Z0\nM2\n";

Result<LinkDelay, std::string> cost_of(const test::JudgedProgram& program) {
  return link_delay(program.program.again(), program.machine, program.options, program.check, program.planned_time());
}

TEST(LineCosts, are_those_of_a_board_with_few_places) {
  const test::JudgedProgram on_uno(test::example_machine("uno"), bends);
  ASSERT_TRUE(has_line_cost(on_uno.machine, on_uno.check));
  const auto few = cost_of(on_uno);
  ASSERT_TRUE(few) << few.error();
  EXPECT_EQ(few->held_items, 42);
  EXPECT_EQ(few->trouble, "");
  EXPECT_GT(few->cost(), Seconds(0));
  EXPECT_EQ(few->without, on_uno.planned_time());
  EXPECT_NEAR(few->share(), few->cost() / few->without, 1e-12);
  MachineDescription roomy = test::example_machine("uno");
  roomy.board.held_items = 250;
  const auto many = cost_of(test::JudgedProgram(roomy, bends));
  ASSERT_TRUE(many);
  EXPECT_LT(many->cost(), few->cost());
}

TEST(LineCosts, are_not_told_where_no_places_are_named_or_a_probe_decides) {
  const test::JudgedProgram on_router(test::example_machine("router"), bends);
  EXPECT_FALSE(has_line_cost(on_router.machine, on_router.check));
  const test::JudgedProgram probes(test::example_machine("uno"), "G21 G90 F60\nG38.2 Z-1\nM2\n");
  EXPECT_FALSE(has_line_cost(probes.machine, probes.check));
}

TEST(LineCosts, are_never_below_zero) {
  const LinkDelay cost{.without = Seconds(2), .over = Seconds(1)};
  EXPECT_EQ(cost.cost(), Seconds(0));
  EXPECT_EQ(cost.share(), 0);
  EXPECT_EQ(LinkDelay{}.share(), 0);
}

}  // namespace
}  // namespace passo
