#include "passo/geometry/curve.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>

#include "kit/seed.hpp"

namespace passo {
namespace {

using Real = long double;

Point point_of(double x, double y, double z) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

// An arc as the test made it up. The oracle walks it in polar form, with its own numbers.
struct Drawn {
  Axis first = Axis::x;
  Axis second = Axis::y;
  Real first_center = 0;
  Real second_center = 0;
  Real start_radius = 0;
  Real end_radius = 0;
  Real start_angle = 0;
  Real sweep = 0;
  Point start;
  Point end;

  Real first_at(Real share) const {
    return first_center + (start_radius + share * (end_radius - start_radius)) * std::cos(start_angle + share * sweep);
  }
  Real second_at(Real share) const {
    return second_center + (start_radius + share * (end_radius - start_radius)) * std::sin(start_angle + share * sweep);
  }
  Real other_at(Axis axis, Real share) const { return start[axis] + share * (Real(end[axis]) - Real(start[axis])); }
  Real value_at(Axis axis, Real share) const {
    if (axis == first) return first_at(share);
    if (axis == second) return second_at(share);
    return other_at(axis, share);
  }
  Curve curve() const {
    return Curve::arc(start, end, first, second, static_cast<double>(first_center), static_cast<double>(second_center),
                      static_cast<double>(sweep));
  }
};

class RandomArcs : public testing::Test {
 protected:
  RandomArcs() {
    seed_ = test::seed();
    random_.seed(seed_);
    RecordProperty("seed", std::to_string(seed_));
  }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Drawn draw(bool spiral) {
    static constexpr std::array<std::array<Axis, 2>, 3> planes = {
        {{Axis::x, Axis::y}, {Axis::z, Axis::x}, {Axis::y, Axis::z}}};
    const auto& plane = planes[static_cast<std::size_t>(between(0, 2.999))];
    Drawn drawn;
    drawn.first = plane[0];
    drawn.second = plane[1];
    drawn.first_center = between(-100, 100);
    drawn.second_center = between(-100, 100);
    drawn.start_radius = std::exp(between(-3, 5));
    drawn.start_angle = between(-3.14, 3.14);
    const double size = between(0, 1) < 0.7 ? between(0.001, 6.28) : between(6.29, 40);
    drawn.sweep = between(0, 1) < 0.5 ? size : -size;
    // A slight spiral, as programs with rounded numbers ask for: it moves much less outward than around.
    const double growth = spiral ? between(-0.03, 0.03) : 0;
    drawn.end_radius = drawn.start_radius * Real(1 + growth * std::min(1.0, size));
    for (const Axis axis : all_axes) {
      drawn.start[axis] = between(-50, 50);
      drawn.end[axis] = between(0, 1) < 0.5 ? drawn.start[axis] : between(-50, 50);
    }
    drawn.start[drawn.first] = static_cast<double>(drawn.first_at(0));
    drawn.start[drawn.second] = static_cast<double>(drawn.second_at(0));
    drawn.end[drawn.first] = static_cast<double>(drawn.first_at(1));
    drawn.end[drawn.second] = static_cast<double>(drawn.second_at(1));
    return drawn;
  }

  std::uint64_t seed_ = 0;
  std::mt19937_64 random_;
};

TEST(Line, ends_where_it_was_told_to_bit_for_bit) {
  const Point start = point_of(0.1, 0.2, 0.3);
  const Point end = point_of(1.0 / 3, -7.7, 1e6);
  const Curve line = Curve::line(start, end);
  EXPECT_EQ(line.at(Mm(0)), start);
  EXPECT_EQ(line.at(line.length()), end);
}

TEST(Line, counts_xyz_then_uvw_then_abc) {
  Point end = point_of(3, 4, 0);
  end[Axis::u] = 100;
  end[Axis::a] = 1000;
  EXPECT_DOUBLE_EQ(Curve::line(Point{}, end).length().value(), 5);
  EXPECT_DOUBLE_EQ(Curve::line(Point{}, end).tangent(Mm(1))[Axis::a], 200);
  end[Axis::x] = end[Axis::y] = 0;
  EXPECT_DOUBLE_EQ(Curve::line(Point{}, end).length().value(), 100);
  end[Axis::u] = 0;
  EXPECT_DOUBLE_EQ(Curve::line(Point{}, end).length().value(), 1000);
  end[Axis::a] = 0;
  EXPECT_FALSE(Curve::line(Point{}, end).has_length());
}

TEST(Line, has_length_if_any_axis_moves_by_more_than_rounding) {
  Point end = point_of(9.7e-16, 0, 0);
  EXPECT_FALSE(Curve::line(Point{}, end).has_length());
  end[Axis::a] = 90;
  EXPECT_TRUE(Curve::line(Point{}, end).has_length());
  EXPECT_TRUE(Curve::line(Point{}, point_of(0, 2e-12, 0)).has_length());
}

TEST(Line, without_length_stays_finite) {
  const Curve line = Curve::line(point_of(1, 2, 3), point_of(1, 2, 3));
  EXPECT_EQ(line.tangent(Mm(0)), Point{});
  EXPECT_EQ(line.at(Mm(0)), point_of(1, 2, 3));
}

TEST(Arc, a_quarter_circle_is_where_school_says) {
  const Curve arc = Curve::arc(point_of(10, 0, 0), point_of(0, 10, 0), Axis::x, Axis::y, 0, 0, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(arc.length().value(), 5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(arc.curvature(), 0.1);
  EXPECT_NEAR(arc.at(arc.length() / 2)[Axis::x], std::sqrt(50), 1e-14);
  EXPECT_NEAR(arc.tangent(Mm(0))[Axis::y], 1, 1e-15);
  EXPECT_NEAR(arc.tangent(arc.length())[Axis::x], -1, 1e-15);
}

TEST(Arc, a_full_circle_touches_all_four_sides) {
  const Curve arc = Curve::arc(point_of(3, 4, 0), point_of(3, 4, 0), Axis::x, Axis::y, 0, 0, -2 * std::numbers::pi);
  const Box box = arc.extents();
  EXPECT_DOUBLE_EQ(box.low[Axis::x], -5);
  EXPECT_DOUBLE_EQ(box.high[Axis::x], 5);
  EXPECT_DOUBLE_EQ(box.low[Axis::y], -5);
  EXPECT_DOUBLE_EQ(box.high[Axis::y], 5);
}

TEST(Arc, steepest_of_a_short_arc_is_less_than_one_on_the_axis_it_hardly_moves) {
  // From 3 to 4 o'clock X changes slowly: at most sin 30 degrees.
  const double angle = -std::numbers::pi / 6;
  const Curve arc =
      Curve::arc(point_of(1, 0, 0), point_of(std::cos(angle), std::sin(angle), 0), Axis::x, Axis::y, 0, 0, angle);
  EXPECT_NEAR(arc.steepest()[Axis::x], 0.5, 1e-14);
  EXPECT_NEAR(arc.steepest()[Axis::y], 1, 1e-14);
}

TEST_F(RandomArcs, are_where_the_polar_form_puts_them) {
  for (int n = 0; n < 2000; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " arc " << n);
    const Drawn drawn = draw(n % 2 == 0);
    const Curve curve = drawn.curve();
    ASSERT_EQ(curve.at(Mm(0)), drawn.start);
    ASSERT_EQ(curve.at(curve.length()), drawn.end);
    for (int k = 1; k < 40; ++k) {
      const double share = k / 40.0;
      const Point point = curve.at(curve.length() * share);
      for (const Axis axis : all_axes) {
        ASSERT_NEAR(point[axis], static_cast<double>(drawn.value_at(axis, share)), 1e-10) << letter_of(axis);
      }
    }
  }
}

TEST_F(RandomArcs, tangents_agree_with_differences_and_stay_under_the_steepest) {
  for (int n = 0; n < 1000; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " arc " << n);
    const bool spiral = n % 2 == 0;
    const Drawn drawn = draw(spiral);
    const Curve curve = drawn.curve();
    const Real length = curve.length().value();
    const Real step = 1e-6L;
    // Even a difference of long doubles has rounding noise, most on a short arc.
    const double noise = 1e-9 + 1e-10 / static_cast<double>(length);
    const Point steepest = curve.steepest();
    Point found;
    for (int k = 0; k <= 2000; ++k) {
      const Real share = k / Real(2000);
      for (const Axis axis : all_axes) {
        const Real slope =
            (drawn.value_at(axis, share + step) - drawn.value_at(axis, share - step)) / (2 * step * length);
        found[axis] = std::max(found[axis], static_cast<double>(std::abs(slope)));
        if (k % 200 == 0) {
          const double tangent = curve.tangent(curve.length() * static_cast<double>(share))[axis];
          ASSERT_NEAR(tangent, static_cast<double>(slope), 1e-7 * (1 + std::abs(tangent)) + noise) << letter_of(axis);
        }
      }
    }
    for (const Axis axis : all_axes) {
      ASSERT_LE(found[axis], steepest[axis] * (1 + 1e-9) + noise) << letter_of(axis);
      // The bound is not loose either: a true arc reaches its steepest place, a spiral nearly does.
      ASSERT_GE(found[axis] * (spiral ? 1.1 : 1 + 1e-3) + (spiral ? 0.1 : 1e-6), steepest[axis]) << letter_of(axis);
    }
  }
}

TEST_F(RandomArcs, have_a_unit_tangent_and_the_curvature_of_the_second_difference) {
  for (int n = 0; n < 500; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " arc " << n);
    const Drawn drawn = draw(false);
    const Curve curve = drawn.curve();
    const Real length = curve.length().value();
    const Real share = between(0.1, 0.9);
    Real squares = 0;
    Real bend = 0;
    const Real step = std::min(0.05L, 0.01L / std::abs(drawn.sweep));
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      const double tangent = curve.tangent(Mm(static_cast<double>(share * length)))[axis];
      squares += Real(tangent) * tangent;
      const Real second =
          (drawn.value_at(axis, share + step) - 2 * drawn.value_at(axis, share) + drawn.value_at(axis, share - step)) /
          (step * step * length * length);
      bend += second * second;
    }
    ASSERT_NEAR(static_cast<double>(squares), 1, 1e-12);
    ASSERT_NEAR(static_cast<double>(std::sqrt(bend)), curve.curvature(), 2e-5 * curve.curvature() + 1e-9);
  }
}

TEST_F(RandomArcs, extents_hold_every_point_and_are_touched) {
  for (int n = 0; n < 1000; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " arc " << n);
    const Drawn drawn = draw(n % 2 == 0);
    const Box box = drawn.curve().extents();
    Point low = drawn.start;
    Point high = drawn.start;
    const int samples = 400 + static_cast<int>(400 * std::abs(drawn.sweep));
    for (int k = 0; k <= samples; ++k) {
      for (const Axis axis : all_axes) {
        const auto value = static_cast<double>(drawn.value_at(axis, Real(k) / samples));
        low[axis] = std::min(low[axis], value);
        high[axis] = std::max(high[axis], value);
      }
    }
    // Between two samples the arc bulges by r·(angle step)²/8.
    const double bulge = static_cast<double>(drawn.start_radius) * 1e-5;
    const Curve curve = drawn.curve();
    const Box bounds = curve.bounds();
    for (const Axis axis : all_axes) {
      ASSERT_LE(bounds.low[axis], box.low[axis]) << letter_of(axis);
      ASSERT_GE(bounds.high[axis], box.high[axis]) << letter_of(axis);
      ASSERT_GE(curve.steepest_bound()[axis], curve.steepest()[axis]) << letter_of(axis);
      ASSERT_EQ(curve.moves(axis), curve.steepest()[axis] > 0) << letter_of(axis);
      ASSERT_LE(box.low[axis], low[axis] + 1e-10) << letter_of(axis);
      ASSERT_GE(box.high[axis], high[axis] - 1e-10) << letter_of(axis);
      ASSERT_GE(box.low[axis], low[axis] - bulge - 1e-10) << letter_of(axis);
      ASSERT_LE(box.high[axis], high[axis] + bulge + 1e-10) << letter_of(axis);
    }
  }
}

TEST(CurveTurning, is_the_angle_in_the_plane_and_stays_bounded_where_another_axis_goes_much_farther) {
  EXPECT_EQ(Curve::line(point_of(0, 0, 0), point_of(3, 4, 0)).turning(), 0);
  EXPECT_EQ(Curve::arc(point_of(1, 0, 0), point_of(0, 1, 0), Axis::x, Axis::y, 0, 0, -1.5 * std::numbers::pi).turning(),
            1.5 * std::numbers::pi);
  // A parabola: its slope changes evenly from (1, 0) to (1, 0.2).
  EXPECT_NEAR(
      Curve::cubic(point_of(0, 0, 0), point_of(1, 0, 0), point_of(2, 0.2, 0), point_of(1, 0.2, 0), Mm(2)).turning(),
      0.2, 1e-12);
  // From rest over 100 degrees to rest, within a thousandth of a millimetre.
  Point end = point_of(0.001, 0, 0);
  end[Axis::a] = 100;
  EXPECT_NEAR(Curve::cubic(Point(), point_of(1, 0, 0), end, point_of(1, 0, 0), Mm(0.001)).turning(), 4, 1e-9);
}

TEST_F(RandomArcs, a_length_is_the_sum_of_its_chords) {
  for (int n = 0; n < 100; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " arc " << n);
    const Drawn drawn = draw(false);
    Real sum = 0;
    const int chords = 4000;
    for (int k = 0; k < chords; ++k) {
      Real squares = 0;
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        const Real step = drawn.value_at(axis, Real(k + 1) / chords) - drawn.value_at(axis, Real(k) / chords);
        squares += step * step;
      }
      sum += std::sqrt(squares);
    }
    ASSERT_NEAR(drawn.curve().length().value() / static_cast<double>(sum), 1, 1e-5);
  }
}

// The polynomial by hand: at(s) and its derivatives, compared with differences in long double.
class RandomCubics : public testing::Test {
 protected:
  Curve draw() {
    const auto any = [&] { return value_(random_); };
    const Point start = point_of(any(), any(), any());
    const Point end = point_of(any(), any(), any());
    const Point in = point_of(any(), any(), any());
    const Point out = point_of(any(), any(), any());
    return Curve::cubic(start, in, end, out, Mm(0.1 + std::abs(any())));
  }
  std::mt19937_64 random_{test::seed()};
  std::uniform_real_distribution<double> value_{-5, 5};
};

TEST_F(RandomCubics, meet_their_ends_and_the_slopes_there) {
  for (int n = 0; n < 1000; ++n) {
    const Curve curve = draw();
    const double length = curve.length().value();
    EXPECT_EQ(curve.at(Mm(0)), curve.start());
    EXPECT_EQ(curve.at(curve.length()), curve.end());
    const double almost = length * (1 - 1e-9);
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      ASSERT_NEAR(curve.at(Mm(almost))[axis], curve.end()[axis], 1e-7);
      const double h = length * 1e-5;
      const double slope = (curve.at(Mm(length / 2 + h))[axis] - curve.at(Mm(length / 2 - h))[axis]) / (2 * h);
      ASSERT_NEAR(curve.tangent(Mm(length / 2))[axis], slope, 1e-4);
      const double bend = (curve.tangent(Mm(length / 2 + h))[axis] - curve.tangent(Mm(length / 2 - h))[axis]) / (2 * h);
      ASSERT_NEAR(curve.second_derivative(Mm(length / 2))[axis], bend, 1e-4 * (1 + std::abs(bend)));
    }
  }
}

// The third derivative of a cubic and of a spiral, compared with differences of the second one.
TEST_F(RandomCubics, and_spirals_have_the_third_derivative_of_their_bend) {
  for (int n = 0; n < 1000; ++n) {
    const Point start = point_of(3 + value_(random_) / 5, 0, value_(random_));
    const Point end = point_of(0, 4 + value_(random_) / 5, value_(random_));
    const Curve spiral = Curve::arc(start, end, Axis::x, Axis::y, 0, 0, std::numbers::pi / 2);
    for (const Curve& curve : {draw(), spiral}) {
      const double middle = curve.length().value() / 2;
      const double h = middle * 1e-4;
      const Point change =
          (curve.second_derivative(Mm(middle + h)) - curve.second_derivative(Mm(middle - h))) * (0.5 / h);
      const Point third = curve.third_derivative(Mm(middle));
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        ASSERT_NEAR(third[axis], change[axis], 1e-5 * (1 + std::abs(change[axis])));
      }
    }
  }
}

TEST_F(RandomCubics, turning_points_are_where_an_axis_stands) {
  int found = 0;
  for (int n = 0; n < 300; ++n) {
    const Curve curve = draw();
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      for (const Mm s : curve.turning_points(axis)) {
        if (s < Mm(0)) continue;
        ASSERT_LT(s, curve.length());
        ASSERT_NEAR(curve.tangent(s)[axis], 0, 1e-9);
        ++found;
      }
    }
  }
  EXPECT_GT(found, 100);
}

TEST_F(RandomCubics, extents_and_steepest_hold_and_are_touched) {
  for (int n = 0; n < 300; ++n) {
    const Curve curve = draw();
    const Box box = curve.extents();
    const Point steepest = curve.steepest();
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      double low = 1e9, high = -1e9, steep = 0;
      for (int i = 0; i <= 2000; ++i) {
        const Mm s = curve.length() * (i / 2000.0);
        low = std::min(low, curve.at(s)[axis]);
        high = std::max(high, curve.at(s)[axis]);
        steep = std::max(steep, std::abs(curve.tangent(s)[axis]));
      }
      const double slack = 1e-4 * (1 + high - low);
      ASSERT_GE(low, box.low[axis] - 1e-9);
      ASSERT_LE(high, box.high[axis] + 1e-9);
      ASSERT_NEAR(low, box.low[axis], slack);
      ASSERT_NEAR(high, box.high[axis], slack);
      ASSERT_GE(curve.steepest_bound()[axis], steepest[axis]);
      ASSERT_EQ(curve.moves(axis), steepest[axis] > 0);
      ASSERT_GE(steepest[axis], steep - 1e-9);
      ASSERT_NEAR(steepest[axis], steep, 1e-3 * (1 + steep));
    }
  }
}

void expect_same(const Point& a, const Point& b, double tolerance) {
  for (const Axis axis : all_axes) ASSERT_NEAR(a[axis], b[axis], tolerance) << letter_of(axis);
}

void expect_part_of(const Curve& whole, double from, double to) {
  const Mm start = whole.length() * from;
  const Curve part = whole.part(start, whole.length() * to);
  EXPECT_EQ(part.start(), whole.at(start));
  EXPECT_EQ(part.end(), whole.at(whole.length() * to));
  for (const double share : {0.0, 0.3, 0.9, 1.0}) {
    const Mm s = part.length() * share;
    expect_same(part.at(s), whole.at(start + s), 1e-10);
    expect_same(part.tangent(s), whole.tangent(start + s), 1e-10);
    expect_same(part.second_derivative(s), whole.second_derivative(start + s), 1e-8);
  }
}

TEST_F(RandomCubics, have_parts_that_are_the_same_curve) {
  for (int n = 0; n < 100; ++n) expect_part_of(draw(), 0.2, 0.7);
}

TEST(Arc, parts_of_a_spiral_and_a_line_are_the_same_curve) {
  const Curve spiral = Curve::arc(point_of(5, 0, 1), point_of(0, 9, 4), Axis::x, Axis::y, 0, 0, 7.8539816339744831);
  expect_part_of(spiral, 0, 0.4);
  expect_part_of(spiral, 0.35, 1);
  expect_part_of(Curve::line(point_of(1, 2, 3), point_of(-4, 0, 9)), 0.1, 0.6);
}

}  // namespace
}  // namespace passo
