#include "passo/study/method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/study/measure.hpp"

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const StepMove line{.from = {3, 4}, .to = {13, 0}, .arc = {}};
const StepMove space{.from = {0, 0, 0}, .to = {5, -3, 2}, .arc = {}};
const StepMove arc{.from = {10, 0}, .to = {0, 10}, .arc = StepMove::Arc{.centre = {0, 0}, .clockwise = false}};

std::vector<std::string> titles(const StepMove& move) {
  std::vector<std::string> found;
  for (const Method& method : methods_for(move)) found.push_back(title(method));
  return found;
}

TEST(Methods, that_take_a_move_are_offered) {
  EXPECT_THAT(titles(line), ElementsAre("master-slave", "lean", "dda", "dda, half loaded", "slope-recalculated",
                                        "slope-blocks", "point-comparison"));
  EXPECT_THAT(titles(space), ElementsAre("master-slave", "lean", "dda", "dda, half loaded"));
  EXPECT_THAT(titles(arc), ElementsAre("dda", "dda, half loaded", "point-comparison", "midpoint"));
}

TEST(Methods, all_end_on_the_end_point) {
  for (const StepMove& move : {line, space, arc}) {
    for (const Method& method : methods_for(move)) {
      auto source = start(method, move);
      ASSERT_TRUE(source) << title(method);
      Place place = move.from;
      while (!(*source)->done()) apply((*source)->next(), place);
      EXPECT_EQ(place, move.to) << title(method);
    }
  }
}

TEST(Methods, that_do_not_take_a_move_say_why) {
  EXPECT_THAT(start({.name = MethodName::lean}, arc).error(), HasSubstr("for lines"));
  EXPECT_THAT(start({.name = MethodName::midpoint}, line).error(), HasSubstr("for arcs"));
  EXPECT_THAT(start({.name = MethodName::slope_blocks}, space).error(), HasSubstr("two axes"));
  EXPECT_THAT(start({.name = MethodName::dda, .register_bits = 3}, line).error(), HasSubstr("4 to 31 bits"));
}

TEST(Methods, show_their_decision_variables) {
  auto source = start({.name = MethodName::lean}, line);
  EXPECT_THAT((*source)->decision_names(), ElementsAre("decision_x", "decision_y"));
  std::vector<std::int64_t> values;
  (*source)->next();
  (*source)->decisions(values);
  EXPECT_THAT(values, ElementsAre(-10, -2));  // −10 + 2·10 − 2·10, −10 + 2·4
  EXPECT_THAT((*start({.name = MethodName::point_comparison}, arc))->decision_names(), ElementsAre("deviation"));
}

TEST(Methods, bresenham_is_lean_and_of_an_arc_midpoint) {
  EXPECT_EQ(method_named("bresenham"), MethodName::lean);
  EXPECT_EQ(method_named("bresenham", true), MethodName::midpoint);
}

TEST(Methods, have_names) {
  for (const std::string& name : method_names()) EXPECT_EQ(title({.name = *method_named(name)}), name);
  EXPECT_FALSE(method_named("wu"));
}

}  // namespace
}  // namespace passo
