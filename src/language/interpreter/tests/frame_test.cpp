#include "passo/interpreter/frame.hpp"

#include <cmath>
#include <cstdlib>
#include <random>

#include "interpreted.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

Point random_point(std::mt19937_64& random) {
  std::uniform_real_distribution<double> coordinate(-200, 200);
  Point point;
  for (double& value : point.values) value = coordinate(random);
  return point;
}

void expect_near(const Point& a, const Point& b, double tolerance) {
  for (const Axis axis : all_axes) EXPECT_NEAR(a[axis], b[axis], tolerance) << letter_of(axis);
}

TEST(Frame, is_the_identity_until_it_is_moved) {
  const Frame frame;
  std::mt19937_64 random(test::seed());
  const Point point = random_point(random);
  EXPECT_EQ(frame.machine_from_work(point), point);
  EXPECT_EQ(frame.work_from_machine(point), point);
}

TEST(Frame, turns_the_work_and_g92_offset_but_neither_the_work_offset_nor_the_tool) {
  Frame frame;
  Point work, g92, tool, position;
  work[Axis::x] = 100;
  g92[Axis::x] = 10;
  tool[Axis::x] = 1;
  position[Axis::x] = 5;
  EXPECT_TRUE(frame.follow({operation::SetWorkOffset{3, work}, {}}));
  EXPECT_TRUE(frame.follow({operation::SetG92Offset{g92}, {}}));
  EXPECT_TRUE(frame.follow({operation::SetRotation{90}, {}}));
  EXPECT_TRUE(frame.follow({operation::SetToolOffset{tool}, {}}));
  EXPECT_FALSE(frame.follow({operation::StraightFeed{position}, {}}));
  const Point machine = frame.machine_from_work(position);
  EXPECT_EQ(machine[Axis::x], 101);
  EXPECT_EQ(machine[Axis::y], 15);
  EXPECT_EQ(frame.work_system(), 3);
  EXPECT_EQ(frame.work_offset(), work);
}

TEST(Frame, quarter_turns_are_exact) {
  Point position;
  position[Axis::x] = 3;
  position[Axis::y] = 7;
  for (const int quarters : {-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5}) {
    Frame frame;
    frame.follow({operation::SetRotation{quarters * 90.0}, {}});
    const Point machine = frame.machine_from_work(position);
    const double expected[4][2] = {{3, 7}, {-7, 3}, {-3, -7}, {7, -3}};
    const auto turn = static_cast<std::size_t>(((quarters % 4) + 4) % 4);
    EXPECT_EQ(machine[Axis::x], expected[turn][0]) << quarters;
    EXPECT_EQ(machine[Axis::y], expected[turn][1]) << quarters;
  }
}

TEST(Frame, goes_there_and_back) {
  std::mt19937_64 random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  for (int i = 0; i < 1000; ++i) {
    Frame frame;
    frame.follow({operation::SetWorkOffset{1, random_point(random)}, {}});
    frame.follow({operation::SetG92Offset{random_point(random)}, {}});
    frame.follow({operation::SetRotation{random_point(random)[Axis::x]}, {}});
    frame.follow({operation::SetToolOffset{random_point(random)}, {}});
    const Point position = random_point(random);
    expect_near(frame.work_from_machine(frame.machine_from_work(position)), position, 1e-10);
  }
}

// Whatever the offsets: where the frame that follows the operations ends is where G53 was told to go.
TEST(Frame, agrees_with_the_interpreter_about_machine_positions) {
  std::mt19937_64 random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  std::uniform_real_distribution<double> number(-100, 100);
  const auto n = [&] { return std::to_string(number(random)); };
  for (int i = 0; i < 200; ++i) {
    const std::string x = n(), y = n(), z = n(), a = n(), u = n();
    const std::string text = "G21\nG10 L2 P1 X" + n() + " Y" + n() + " Z" + n() + " R" + n() + "\nG0 X" + n() + " Y" +
                             n() + "\nG43.1 Z" + n() + " X" + n() + " A" + n() + "\nG92 X" + n() + " Y" + n() + " U" +
                             n() + "\nG10 L2 P4 X" + n() + " A" + n() + " R" + n() + "\nG57\nG10 L20 P4 X" + n() +
                             "\nG53 G0 X" + x + " Y" + y + " Z" + z + " A" + a + " U" + u + "\n(debug,#5420)\nM2\n";
    const Interpreted result = interpret_text(text);
    ASSERT_FALSE(result.diagnostics.any_error()) << text << result.rendered();
    Frame frame;
    Point machine;
    for (const Operation& operation : result.operations) {
      if (std::holds_alternative<operation::SetFeedMode>(operation.what)) break;  // of M2
      frame.follow(operation);
      if (const auto* move = std::get_if<operation::StraightTraverse>(&operation.what)) {
        machine = frame.machine_from_work(move->end);
      }
    }
    EXPECT_NEAR(machine[Axis::x], std::stod(x), 1e-9) << text;
    EXPECT_NEAR(machine[Axis::y], std::stod(y), 1e-9);
    EXPECT_NEAR(machine[Axis::z], std::stod(z), 1e-9);
    EXPECT_NEAR(machine[Axis::a], std::stod(a), 1e-9);
    EXPECT_NEAR(machine[Axis::u], std::stod(u), 1e-9);
  }
}

}  // namespace
}  // namespace passo
