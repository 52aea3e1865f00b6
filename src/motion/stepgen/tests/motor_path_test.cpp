// The crossings that MotorPath finds several at once, against the curve itself.
#include "motor_path.hpp"

#include <cmath>

#include "kit/stage_test.hpp"
#include "kit/step_oracle.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

class LookAhead : public testing::Test {
 protected:
  test::Random random_;
  StepOptions options_ = two_motors();

  static StepOptions two_motors() {
    StepOptions options;
    options.kinematics = {{.steps = {Axis::x, 400}}, {.steps = {Axis::y, -640}}};
    return options;
  }

  // As programs write arcs: the radius at the end is not quite that at the start.
  Curve random_arc(double climb = 0) {
    const double radius = std::exp(random_.between(-3, 4));
    const double angle = random_.between(-3, 3);
    const double sweep = random_.between(0.3, 6) * (random_.chance(0.5) ? 1 : -1);
    const double end_radius = radius + random_.between(-1e-3, 1e-3);
    Point start;
    start[Axis::x] = radius * std::cos(angle);
    start[Axis::y] = radius * std::sin(angle);
    Point end;
    end[Axis::z] = climb;
    end[Axis::x] = end_radius * std::cos(angle + sweep);
    end[Axis::y] = end_radius * std::sin(angle + sweep);
    return Curve::arc(start, end, Axis::x, Axis::y, 0, 0, sweep);
  }
  Curve random_cubic() {
    const double size = std::exp(random_.between(-3, 2));
    Point end;
    end[Axis::x] = size;
    end[Axis::y] = random_.between(-1, 1) * size;
    Point from;
    from[Axis::x] = random_.between(0.3, 1);
    from[Axis::y] = random_.between(-1, 1);
    Point to;
    to[Axis::x] = random_.between(0.3, 1);
    to[Axis::y] = random_.between(-1, 1);
    return Curve::cubic(Point(), from, end, to, Mm(size * 1.2));
  }

  // Returns the number of crossings found.
  std::size_t expect_exact(const Curve& curve) {
    MotorPath path;
    const double length = curve.length().value();
    path.start(curve, length, options_.kinematics.rows());
    std::size_t found = 0;
    for (unsigned motor = 0; motor < 2; ++motor) {
      const MotorPath::Spot from = path.at(random_.between(0, 0.9) * length);
      const double grid =
          place_per_step / std::exp2(std::floor(random_.between(0, 9))) * (path.slope(motor, from) > 0 ? 1 : -1);
      const double target = path.place(motor, from) + random_.between(0, 1) * grid;
      MotorPath::Spots ahead;
      path.look_ahead(motor, target, grid, from.s, ahead);
      for (std::size_t i = 0; i < ahead.count && ahead.s[i] <= length; ++i, ++found) {
        EXPECT_GE(ahead.s[i], i == 0 ? from.s : ahead.s[i - 1]);
        const long double place = oracle::exact_place(options_.kinematics.rows()[motor], curve, ahead.s[i]);
        EXPECT_NEAR(static_cast<double>(place * place_per_step), target + static_cast<double>(i) * grid, 0.01);
        Lanes other;
        path.places(1 - motor, ahead, other);
        const long double other_place = oracle::exact_place(options_.kinematics.rows()[1 - motor], curve, ahead.s[i]);
        EXPECT_NEAR(static_cast<double>(other_place * place_per_step), other[i], 0.01);
      }
    }
    return found;
  }
};

TEST_F(LookAhead, finds_the_crossings_of_an_arc) {
  std::size_t found = 0;
  for (int run = 0; run < 2000 && !HasFailure(); ++run) found += expect_exact(random_arc());
  EXPECT_GT(found, 20'000U);
}

// Each motor sees both axes of the arc's plane.
TEST_F(LookAhead, finds_the_crossings_of_an_arc_if_axes_share_motors) {
  options_.kinematics = {{.steps = {{Axis::x, 400}, {Axis::y, 400}}}, {.steps = {{Axis::x, 300}, {Axis::y, -500}}}};
  std::size_t found = 0;
  for (int run = 0; run < 2000 && !HasFailure(); ++run) found += expect_exact(random_arc());
  EXPECT_GT(found, 20'000U);
}

// And the axis along which a helix climbs.
TEST_F(LookAhead, finds_the_crossings_of_a_helix_if_axes_share_motors) {
  options_.kinematics = {{.steps = {{Axis::x, 400}, {Axis::z, 400}}},
                         {.steps = {{Axis::x, 300}, {Axis::y, -500}, {Axis::z, 100}}}};
  std::size_t found = 0;
  for (int run = 0; run < 2000 && !HasFailure(); ++run) found += expect_exact(random_arc(random_.between(-9, 9)));
  EXPECT_GT(found, 15'000U);
}

TEST_F(LookAhead, finds_the_crossings_of_a_cubic_if_axes_share_motors) {
  options_.kinematics = {{.steps = {{Axis::x, 400}, {Axis::y, 400}}}, {.steps = {{Axis::x, 300}, {Axis::y, -500}}}};
  std::size_t found = 0;
  for (int run = 0; run < 2000 && !HasFailure(); ++run) found += expect_exact(random_cubic());
  EXPECT_GT(found, 20'000U);
}

TEST_F(LookAhead, finds_the_crossings_of_a_cubic) {
  std::size_t found = 0;
  for (int run = 0; run < 2000 && !HasFailure(); ++run) found += expect_exact(random_cubic());
  EXPECT_GT(found, 20'000U);
}

}  // namespace
}  // namespace passo
