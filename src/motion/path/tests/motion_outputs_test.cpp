// Outputs that the program switches without a stop.
#include "path_test.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::ElementsAre;

constexpr std::uint8_t first = 8;
constexpr std::uint8_t second = 4;

class MotionOutputsTest : public PathTest {
 protected:
  MotionOutputsTest() {
    options_.outputs.digital = {first, second, 0};
    feed(10);
  }
  void use_laser() { options_.outputs.laser = {.maximum_s = 1000, .minimum = 0.1}; }
  void power(double s) { add(operation::SetSpindleSpeed{s}); }
  void laser(SpindleDirection direction) { add(operation::TurnSpindle{direction}); }
  void rapid(double x) { add(operation::StraightTraverse{xyz(x, 0)}); }
  std::vector<double> powers() {
    std::vector<double> found;
    for (const Segment& segment : segments()) found.push_back(segment.outputs.power);
    return found;
  }
  std::vector<int> switches() {
    std::vector<int> found;
    for (const Segment& segment : segments()) found.push_back(segment.outputs.switches.value_or(255));
    return found;
  }
  std::vector<Action> actions() {
    std::vector<Action> found;
    for (const PathItem& item : build()) {
      if (const auto* action = std::get_if<Action>(&item)) found.push_back(*action);
    }
    return found;
  }
};

TEST_F(MotionOutputsTest, a_digital_output_changes_with_the_next_motion_and_needs_no_stop) {
  go(1, 0);
  add(operation::SetDigitalOutput{0, true, true});
  go(2, 0);
  add(operation::SetDigitalOutput{1, true, false});
  go(3, 0);
  add(operation::SetDigitalOutput{0, false, true});
  go(4, 0);
  EXPECT_THAT(switches(), ElementsAre(0, first, first | second, second));
  options_.open_ended = true;
  EXPECT_TRUE(actions().empty());
}

TEST_F(MotionOutputsTest, before_a_stop_only_an_output_that_switches_at_once_does) {
  add(operation::SetDigitalOutput{0, true, true});
  add(operation::SetDigitalOutput{1, true, false});
  add(operation::Dwell{Seconds(1)});
  const std::vector<Action> found = actions();
  ASSERT_GE(found.size(), 2U);
  EXPECT_EQ(found[0].kind, Action::Kind::outputs);
  EXPECT_EQ(found[0].switches, second);
  EXPECT_EQ(found[1].kind, Action::Kind::dwell);
}

TEST_F(MotionOutputsTest, the_end_of_the_program_switches_digital_outputs_off) {
  add(operation::SetDigitalOutput{0, true, true});
  go(1, 0);
  add(operation::ProgramEnd{});
  const std::vector<Action> found = actions();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].switches, 0);
  EXPECT_EQ(found[1].kind, Action::Kind::program_end);
}

TEST_F(MotionOutputsTest, an_output_that_the_machine_lacks_is_reported_once) {
  add(operation::SetDigitalOutput{2, true, true});
  add(operation::SetDigitalOutput{63, true, false});
  add(operation::SetAnalogOutput{0, 5, true});
  go(1, 0);
  EXPECT_THAT(switches(), ElementsAre(0));
  EXPECT_THAT(codes(), ElementsAre("path.no-outputs"));
}

TEST_F(MotionOutputsTest, the_laser_is_on_in_feeds_only) {
  use_laser();
  power(500);
  go(1, 0);
  laser(SpindleDirection::clockwise);
  rapid(2);
  go(3, 0);
  power(250);
  go(4, 0);
  power(0);
  go(5, 0);
  power(1);
  go(6, 0);
  laser(SpindleDirection::off);
  go(7, 0);
  EXPECT_THAT(powers(), ElementsAre(0, 0, 0.5, 0.25, 0, 0.1, 0));
  options_.open_ended = true;
  EXPECT_TRUE(actions().empty());
}

TEST_F(MotionOutputsTest, with_m4_the_power_follows_the_speed) {
  use_laser();
  power(500);
  laser(SpindleDirection::counterclockwise);
  go(1, 0);
  rapid(2);
  laser(SpindleDirection::clockwise);
  go(3, 0);
  std::vector<bool> found;
  for (const Segment& segment : segments()) found.push_back(segment.outputs.follows_speed);
  EXPECT_THAT(found, ElementsAre(true, false, false));
}

TEST_F(MotionOutputsTest, more_than_full_power_is_full_power) {
  use_laser();
  laser(SpindleDirection::clockwise);
  power(1200);
  go(1, 0);
  power(1200);
  go(2, 0);
  EXPECT_THAT(powers(), ElementsAre(1, 1));
  EXPECT_THAT(codes(), ElementsAre("path.laser-too-strong"));
}

TEST_F(MotionOutputsTest, the_analog_output_0_is_the_power_of_the_laser) {
  use_laser();
  laser(SpindleDirection::clockwise);
  add(operation::SetAnalogOutput{0, 300, true});
  go(1, 0);
  add(operation::SetAnalogOutput{1, 300, true});
  EXPECT_THAT(powers(), ElementsAre(0.3));
  EXPECT_THAT(codes(), ElementsAre("path.no-outputs"));
}

TEST_F(MotionOutputsTest, the_laser_is_off_in_a_probe_move) {
  use_laser();
  laser(SpindleDirection::clockwise);
  power(500);
  add(operation::StraightProbe{xyz(1, 0), true, true});
  EXPECT_THAT(powers(), ElementsAre(0));
}

TEST_F(MotionOutputsTest, lines_of_different_power_are_not_merged) {
  use_laser();
  laser(SpindleDirection::clockwise);
  for (int i = 1; i <= 6; ++i) {
    power(i <= 3 ? 100 : 200);
    go(i, 0);
  }
  std::vector<std::pair<double, double>> found;
  for (const Segment& segment : smoothed_segments()) {
    found.emplace_back(segment.curve.end()[Axis::x], segment.outputs.power);
  }
  EXPECT_THAT(found, ElementsAre(testing::Pair(3, 0.1), testing::Pair(6, 0.2)));
}

TEST_F(MotionOutputsTest, without_a_laser_s_is_the_speed_of_a_spindle) {
  power(500);
  laser(SpindleDirection::clockwise);
  go(1, 0);
  EXPECT_THAT(powers(), ElementsAre(0));
  const std::vector<Action> found = actions();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].outputs.revolutions_per_minute, 500);
}

TEST_F(MotionOutputsTest, a_machine_without_digital_outputs_leaves_them_alone) {
  options_.outputs = {};
  go(1, 0);
  EXPECT_THAT(switches(), ElementsAre(255));
}

}  // namespace
}  // namespace passo
