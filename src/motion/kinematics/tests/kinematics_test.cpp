// Motors of an axis of their own, gantries, screws, and motors that axes share: there and back, to the count.
#include "passo/kinematics/kinematics.hpp"

#include <array>
#include <cmath>
#include <memory>

#include "kit/random_point.hpp"
#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::xyz;

Kinematics cartesian() {
  return {{.steps = {Axis::x, 640}}, {.steps = {Axis::y, -100.0 / 3}}, {.steps = {Axis::z, 48}}};
}

// X and Y share two motors, which turn the other way round each other.
Kinematics core_xy() {
  return {
      {.steps = {{Axis::x, 80}, {Axis::y, 80}}}, {.steps = {{Axis::x, 80}, {Axis::y, -80}}}, {.steps = {Axis::z, 400}}};
}

Kinematics with_screw(double steps_per_unit) {
  const auto map = std::make_shared<const ScrewMap>(
      0.15, std::vector<ScrewMap::Error>{{.at = -10, .off = 0.05}, {.at = 10, .off = -0.05}, {.at = 12, .off = -0.04}});
  return {{.steps = {Axis::x, steps_per_unit}, .screw = map}, {.steps = {Axis::y, 100}}};
}

class RandomPlaces : public testing::Test {
 protected:
  test::Random random_;

  Point random_place() { return test::random_point(random_, 300); }
  // Motors at random counts, the axes where these are, and the motors there.
  void expect_counts_come_back(const Kinematics& kinematics, AxisSet downs = {}) {
    for (int i = 0; i < 2000; ++i) {
      SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << random_.seed() << " trial " << i);
      MotorPosition counts;
      for (std::size_t m = 0; m < kinematics.rows().size(); ++m) counts[m] = std::round(random_.between(-2e6, 2e6));
      const MotorPosition back = kinematics.motors(kinematics.axes(counts, downs), downs);
      for (std::size_t m = 0; m < kinematics.rows().size(); ++m) {
        EXPECT_NEAR(back[m], counts[m], 1e-6) << "motor " << m;
        EXPECT_EQ(std::llround(back[m]), std::llround(counts[m])) << "motor " << m;
      }
      if (HasFailure()) return;
    }
  }
  void expect_places_come_back(const Kinematics& kinematics, AxisSet downs = {}) {
    for (int i = 0; i < 2000; ++i) {
      SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << random_.seed() << " trial " << i);
      Point place = random_place();
      for (const Axis axis : all_axes) {
        if (kinematics.steps_per_unit(axis) == 0) place[axis] = 0;
      }
      const Point back = kinematics.axes(kinematics.motors(place, downs), downs);
      for (const Axis axis : all_axes) EXPECT_NEAR(back[axis], place[axis], 1e-9) << letter_of(axis);
      if (HasFailure()) return;
    }
  }
};

TEST_F(RandomPlaces, come_back_on_a_cartesian_machine) {
  expect_counts_come_back(cartesian());
  expect_places_come_back(cartesian());
}

TEST_F(RandomPlaces, come_back_where_axes_share_motors) {
  expect_counts_come_back(core_xy());
  expect_places_come_back(core_xy());
  // One of the motors turns for X alone: the other one tells Y.
  const Kinematics h_bot = {{.steps = {Axis::x, 100}}, {.steps = {{Axis::x, 100}, {Axis::y, 80}}}};
  expect_counts_come_back(h_bot);
  expect_places_come_back(h_bot);
  // Three motors, each of which turns for three axes.
  const Kinematics all_share = {{.steps = {{Axis::x, 80}, {Axis::y, 80}, {Axis::z, 7}}, .offset = 11.25},
                                {.steps = {{Axis::z, -80}, {Axis::x, 80}, {Axis::y, -50}}, .offset = -3},
                                {.steps = {{Axis::y, 30}, {Axis::z, 400}, {Axis::x, -20}}}};
  expect_counts_come_back(all_share);
  expect_places_come_back(all_share);
}

TEST_F(RandomPlaces, come_back_through_a_screw_with_its_play_taken_up_either_way) {
  AxisSet x_down;
  x_down.add(Axis::x);
  for (const double steps_per_unit : {640.0, -640.0}) {
    for (const AxisSet downs : {AxisSet(), x_down}) {
      expect_counts_come_back(with_screw(steps_per_unit), downs);
      expect_places_come_back(with_screw(steps_per_unit), downs);
    }
  }
}

TEST_F(RandomPlaces, are_those_of_the_first_of_two_motors_of_an_axis) {
  const Kinematics gantry = {
      {.steps = {Axis::x, 320}}, {.steps = {Axis::y, 320}}, {.steps = {Axis::z, 640}}, {.steps = {Axis::y, -320}}};
  expect_places_come_back(gantry);
  MotorPosition motors = gantry.motors(xyz(1, 2, 3));
  EXPECT_EQ(motors[1], 640);
  EXPECT_EQ(motors[3], -640);
  motors[3] += 100;  // squared against the first one
  EXPECT_EQ(gantry.axes(motors), xyz(1, 2, 3));
}

TEST(Kinematics, tells_no_place_of_an_axis_without_a_motor) {
  Point others = xyz(7, 8, 9);
  others[Axis::a] = 45;
  const Kinematics machine = {{.steps = {Axis::x, 100}}, {.steps = {Axis::z, 100}}};
  Point place = machine.axes({{100, -50}}, {}, others);
  EXPECT_EQ(place[Axis::x], 1);
  EXPECT_EQ(place[Axis::y], 8);
  EXPECT_EQ(place[Axis::z], -0.5);
  EXPECT_EQ(place[Axis::a], 45);
  EXPECT_EQ(machine.steps_per_unit(Axis::y), 0);
  // Of two axes that share a single motor, one is taken as it was.
  const Kinematics too_few = {{.steps = {{Axis::x, 10}, {Axis::y, 10}}}};
  place = too_few.axes({{100}}, {}, others);
  EXPECT_DOUBLE_EQ(place[Axis::x] + place[Axis::y], 10);
  EXPECT_EQ(place[Axis::y], 8);
}

TEST(Kinematics, never_gives_a_negative_zero) {
  for (const Kinematics& machine : {cartesian(), core_xy()}) {
    for (const double zero : {0.0, -0.0}) {
      const Point place = machine.axes({{zero, zero, zero}});
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) EXPECT_FALSE(std::signbit(place[axis])) << letter_of(axis);
    }
  }
}

TEST(Kinematics, moves_only_the_axes_that_motors_have_turned) {
  const Kinematics machine = core_xy();
  const Point from = xyz(10.0001, 20.0002, 1.0003);
  MotorPosition motors = machine.motors(from);
  motors[2] = 0;
  // Z alone: X and Y stay to the last bit, although their motors do not stand at whole steps.
  const Point lifted = machine.axes_after(from, motors, 0b100);
  EXPECT_EQ(lifted, xyz(10.0001, 20.0002, 0));
  motors[0] += 160;
  const Point moved = machine.axes_after(from, motors, 0b001);
  EXPECT_NEAR(moved[Axis::x], 11.0001, 1e-12);
  EXPECT_NEAR(moved[Axis::y], 21.0002, 1e-12);
  EXPECT_EQ(moved[Axis::z], 1.0003);
}

TEST(Kinematics, counts_from_the_counts_at_zero) {
  const std::array<std::int32_t, max_motors> counts{100, -100, 5};
  const std::array<std::int64_t, 2> zero{-20, 30};
  const MotorPosition place = steps_since(zero, counts);
  EXPECT_EQ(place[0], 120);
  EXPECT_EQ(place[1], -130);
  EXPECT_EQ(place[2], 0);  // a motor that has no count at zero
}

TEST(AxisRow, is_the_sum_of_its_axes) {
  const AxisRow row = {{Axis::x, 2}, {Axis::y, -3}};
  EXPECT_EQ(row.of(xyz(10, 1, 100)), 17);
  EXPECT_EQ(row.most_of(xyz(10, 1, 100)), 23);
  EXPECT_EQ(row.factor_of(Axis::y), -3);
  EXPECT_EQ(row.factor_of(Axis::z), 0);
  EXPECT_FALSE(row.has_one_axis());
  const AxisRow one = {Axis::z, 5};
  EXPECT_TRUE(one.has_one_axis());
  EXPECT_EQ(one.of(xyz(10, 1, 100)), 500);
  EXPECT_EQ(AxisRow().of(xyz(10, 1, 100)), 0);
}

}  // namespace
}  // namespace passo
