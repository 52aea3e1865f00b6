#include "passo/geometry/chords.hpp"

#include "drawn_curves.hpp"
#include "kit/allocation_count.hpp"
#include "kit/seed.hpp"

namespace passo {
namespace {

using test::Place;
using test::Real;

ChordTolerance within(double mm) {
  return *ChordTolerance::of(Mm(mm));
}

template <class C>
std::vector<Chord> cut(const C& curve, double tolerance) {
  Chords chords(curve, within(tolerance));
  std::vector<Chord> all;
  for (Chord chord; chords.next(chord);) all.push_back(chord);
  return all;
}

template <class C>
std::size_t pieces_of(const C& curve) {
  std::size_t pieces = 0;
  for (double u = curve.range().low; u < curve.range().high; u = curve.next_break(u)) ++pieces;
  return pieces;
}

// The fewest chords that any choice of end points gives: the shortest way through all possible chords. The ends are
// restricted to `grid` places on each piece.
template <class C>
std::size_t fewest(const C& curve, const test::Oracle& oracle, double tolerance, double widest) {
  constexpr std::size_t grid = 120;
  std::size_t sum = 0;
  for (double low = curve.range().low; low < curve.range().high; low = curve.next_break(low)) {
    const Real whole = curve.next_break(low) - Real(low);
    std::vector<Place> places;
    for (std::size_t i = 0; i <= grid; ++i) places.push_back(oracle(low + whole * i / grid));
    std::vector<std::size_t> count(grid + 1, grid + 1);
    count[0] = 0;
    for (std::size_t i = 0; i < grid; ++i) {
      for (std::size_t j = i + 1; j <= grid && whole * (j - i) / grid <= widest; ++j) {
        bool good = true;
        for (std::size_t k = i + 1; k < j && good; ++k) {
          good = test::distance(places[k], places[i], places[j]) <= tolerance;
        }
        if (good) count[j] = std::min(count[j], count[i] + 1);
      }
    }
    sum += count[grid];
  }
  return sum;
}

class RandomChords : public testing::Test {
 protected:
  std::uint64_t seed_ = test::seed();
  test::CurveDrawer drawer_{seed_};
};

TEST_F(RandomChords, stay_within_the_tolerance_and_end_exactly_at_the_end) {
  std::size_t checked = 0;
  for (int n = 0; n < 1400; ++n) {
    const test::DrawnCurve drawn = drawer_.draw(n);
    const double tolerance = std::exp(drawer_.between(std::log(1e-4), std::log(10)));
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " curve " << n << ", " << drawn.kind << ", "
                                    << tolerance);
    std::visit(
        [&](const auto& curve) {
          double u = curve.range().low;
          Place place = test::exact(curve.at(u));
          const std::vector<Chord> all = cut(curve, tolerance);
          ASSERT_FALSE(all.empty());
          const std::size_t stride = 1 + all.size() / 300;
          for (std::size_t i = 0; i < all.size(); ++i) {
            const Chord& chord = all[i];
            ASSERT_EQ(chord.from, u);
            ASSERT_GT(chord.to, u);
            ASSERT_LE(chord.deviation, Mm(tolerance * (1 + 1e-11)));
            ASSERT_EQ(chord.end, curve.at(chord.to));
            const Place end = test::exact(chord.end);
            for (int k = 1; k < 50 && i % stride == 0; ++k) {
              const Real between = u + (Real(chord.to) - u) * k / 50;
              ASSERT_LE(test::distance(drawn.oracle(between), place, end), chord.deviation.value() + 1e-9);
              ++checked;
            }
            u = chord.to;
            place = end;
          }
          ASSERT_EQ(u, curve.range().high);
          ASSERT_EQ(all.back().end, curve.at(curve.range().high));
        },
        drawn.curve);
  }
  EXPECT_GT(checked, 250'000U);
}

TEST_F(RandomChords, are_nearly_as_few_as_the_shortest_way_through_all_possible_ends) {
  std::array<std::size_t, test::CurveDrawer::kinds> cut_sum{};
  std::array<std::size_t, test::CurveDrawer::kinds> fewest_sum{};
  for (int n = 0; n < 280; ++n) {
    const test::DrawnCurve drawn = drawer_.draw(n);
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " curve " << n << ", " << drawn.kind);
    std::visit(
        [&](const auto& curve) {
          // A tolerance for which a piece needs about ten chords: the deviation grows with the square of the chord.
          const ParameterRange range = curve.range();
          Real size = 0;
          for (int k = 0; k <= 20; ++k) {
            const Real u = range.low + (Real(range.high) - range.low) * k / 20;
            size = std::max(size, test::apart(drawn.oracle(u), drawn.oracle(range.low)));
          }
          const double tolerance = static_cast<double>(size) * (drawn.kind == "helix" ? 0.05 : 0.002) + 1e-6;
          // Arcs and ellipses are cut into half turns at most. The other curves have no such rule.
          double widest = range.high - range.low;
          while (!std::isfinite(curve.deviation(range.low, range.low + widest).value())) widest *= 0.99;
          const std::size_t count = cut(curve, tolerance).size();
          const std::size_t best = fewest(curve, drawn.oracle, tolerance, widest);
          // The grid misses the best ends by a little, so our count may even be lower.
          EXPECT_LE(count, best + best / 10 + pieces_of(curve) + 1) << tolerance;
          cut_sum[static_cast<std::size_t>(n % test::CurveDrawer::kinds)] += count;
          fewest_sum[static_cast<std::size_t>(n % test::CurveDrawer::kinds)] += best;
        },
        drawn.curve);
  }
  for (std::size_t kind = 0; kind < cut_sum.size(); ++kind) {
    EXPECT_LE(cut_sum[kind] * 100, fewest_sum[kind] * 115) << "kind " << kind;
  }
}

TEST_F(RandomChords, are_twice_as_many_for_a_quarter_of_the_tolerance) {
  for (int n = 0; n < 140; ++n) {
    const test::DrawnCurve drawn = drawer_.draw(n);
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " curve " << n << ", " << drawn.kind);
    std::visit(
        [&](const auto& curve) {
          double tolerance = 0.01;
          while (tolerance > 1e-5 && cut(curve, tolerance).size() < 200 * pieces_of(curve)) tolerance /= 4;
          const auto few = static_cast<double>(cut(curve, tolerance).size());
          const auto many = static_cast<double>(cut(curve, tolerance / 4).size());
          if (few < 200.0 * static_cast<double>(pieces_of(curve))) return;  // straight, or nearly
          EXPECT_NEAR(many / few, 2, 0.05);
        },
        drawn.curve);
  }
}

Curve circle(double radius, double turns, double rise) {
  Point start;
  start[Axis::x] = radius;
  Point end = start;
  end[Axis::z] = rise;
  return Curve::arc(start, end, Axis::x, Axis::y, 0, 0, turns * 2 * std::numbers::pi);
}

TEST(Chords, of_a_circle_are_the_fewest_equal_ones_that_the_sagitta_allows) {
  for (const int sides : {3, 4, 6, 7, 12, 100, 1001, 8765}) {
    const double radius = 25;
    const double sagitta = radius * (1 - std::cos(std::numbers::pi / sides));
    const CurveInSpace curve = *CurveInSpace::of(circle(radius, 1, 0));
    EXPECT_EQ(cut(curve, sagitta * (1 + 1e-9)).size(), static_cast<std::size_t>(sides));
    const std::vector<Chord> all = cut(curve, sagitta * (1 - 1e-9));
    ASSERT_EQ(all.size(), static_cast<std::size_t>(sides) + 1);
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_NEAR(length(all[i].end - all[i - 1].end), 2 * radius * std::sin(std::numbers::pi / (sides + 1)), 1e-11);
    }
    // The reference's formula, from the chord's length.
    const double chord = length(all[1].end - all[0].end);
    EXPECT_NEAR(all[1].deviation.value(), radius - std::sqrt(radius * radius - chord * chord / 4), 1e-11);
  }
}

TEST(Chords, of_a_helix_are_those_of_its_circle_whatever_the_pitch) {
  for (const double rise : {0.0, 1.0, 300.0}) {
    const CurveInSpace helix = *CurveInSpace::of(circle(10, 100, rise));
    EXPECT_EQ(cut(helix, 0.01).size(), cut(*CurveInSpace::of(circle(10, 100, 0)), 0.01).size()) << rise;
  }
}

TEST(Chords, of_a_circle_as_an_arc_as_an_ellipse_and_as_a_nurbs_are_the_same) {
  const double r = 10;
  const double w = std::sqrt(0.5);
  const Nurbs spline = *Nurbs::create(
      {.degree = 2,
       .control =
           {{r, 0, 0}, {r, r, 0}, {0, r, 0}, {-r, r, 0}, {-r, 0, 0}, {-r, -r, 0}, {0, -r, 0}, {r, -r, 0}, {r, 0, 0}},
       .weights = {1, w, 1, w, 1, w, 1, w, 1},
       .knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}});
  const Ellipse ellipse = *Ellipse::flat({}, Mm(r), Mm(r), {0}, {0}, {2 * std::numbers::pi});
  const CurveInSpace arc = *CurveInSpace::of(circle(r, 1, 0));
  for (const double tolerance : {1.0, 0.1, 0.01, 0.001, 1e-5}) {
    const std::vector<Chord> of_arc = cut(arc, tolerance);
    const std::vector<Chord> of_ellipse = cut(ellipse, tolerance);
    ASSERT_EQ(of_arc.size(), of_ellipse.size());
    for (std::size_t i = 0; i < of_arc.size(); ++i) EXPECT_LT(length(of_arc[i].end - of_ellipse[i].end), 1e-12);
    // Four pieces, each with one chord that is not full, and three per cent for the search.
    const std::size_t of_spline = cut(spline, tolerance).size();
    EXPECT_GE(of_spline, of_arc.size());
    EXPECT_LE(static_cast<double>(of_spline), static_cast<double>(of_arc.size()) * 1.03 + 4);
    for (const Chord& chord : cut(spline, tolerance)) EXPECT_NEAR(std::hypot(chord.end.x, chord.end.y), r, 1e-13);
  }
}

TEST(Chords, do_not_lose_a_circle_that_is_smaller_than_the_tolerance) {
  EXPECT_EQ(cut(*CurveInSpace::of(circle(1, 1, 0)), 1000).size(), 2U);
  EXPECT_EQ(cut(*Ellipse::flat({}, Mm(3), Mm(1), {0}, {0}, {2 * std::numbers::pi}), 1000).size(), 2U);
}

TEST(Chords, of_a_straight_curve_are_one) {
  const auto one = [](const auto& curve) { return cut(curve, 1e-6).size() == 1; };
  EXPECT_TRUE(one(*CurveInSpace::of(Curve::line(Point{}, circle(5, 1, 7).end()))));
  EXPECT_TRUE(one(*QuadraticBezier::create({Vector3{0, 0, 0}, {1, 2, 3}, {3, 6, 9}})));
  EXPECT_TRUE(one(*CubicBezier::create({Vector3{0, 0, 0}, {0, 0, 0}, {3, 6, 9}, {3, 6, 9}})));
  EXPECT_TRUE(one(*Nurbs::create({.degree = 3, .control = {{0, 0, 0}, {5, 0, 0}, {6, 0, 0}, {9, 0, 0}}})));
}

TEST(Chords, of_a_curve_that_is_a_point_are_one_of_no_length_at_most) {
  const Vector3 p = {1, 2, 3};
  EXPECT_EQ(cut(*CubicBezier::create({p, p, p, p}), 0.01).size(), 1U);
  EXPECT_EQ(cut(*CurveInSpace::of(Curve::line(Point{}, Point{})), 0.01).size(), 0U);
}

// x goes out and back on one line: the middle of the interval does not show how far.
TEST(Chords, follow_a_straight_curve_that_turns_back) {
  const CubicBezier there_and_back = *CubicBezier::create({Vector3{0, 0, 0}, {10, 0, 0}, {10, 0, 0}, {0, 0, 0}});
  double farthest = 0;
  for (const Chord& chord : cut(there_and_back, 0.01)) farthest = std::max(farthest, chord.end.x);
  EXPECT_GE(farthest, 7.49);
  EXPECT_LE(farthest, 7.5);
}

// The middle of an S lies on its chord.
TEST(Chords, are_not_fooled_by_an_inflection_in_the_middle) {
  const CubicBezier s = *CubicBezier::create({Vector3{0, 0, 0}, {10, 10, 0}, {0, -10, 0}, {10, 0, 0}});
  EXPECT_GT(cut(s, 0.1).size(), 4U);
}

TEST(Chords, pass_a_cusp) {
  const CubicBezier cusp = *CubicBezier::create({Vector3{0, 0, 0}, {10, 10, 0}, {0, 10, 0}, {10, 0, 0}});
  const std::vector<Chord> all = cut(cusp, 0.001);
  EXPECT_LT(all.size(), 200U);
  double highest = 0;
  for (const Chord& chord : all) highest = std::max(highest, chord.end.y);
  EXPECT_NEAR(highest, 7.5, 0.001);
}

TEST(Chords, take_no_tolerance_below_a_nanometre) {
  EXPECT_FALSE(ChordTolerance::of(Mm(0)).has_value());
  EXPECT_FALSE(ChordTolerance::of(Mm(-1)).has_value());
  EXPECT_FALSE(ChordTolerance::of(Mm(std::nan(""))).has_value());
  EXPECT_TRUE(ChordTolerance::of(Mm(1e-6)).has_value());
}

TEST(Chords, of_the_finest_tolerance_on_a_large_circle_come_to_an_end) {
  const CurveInSpace large = *CurveInSpace::of(circle(90000, 1, 0));
  const std::vector<Chord> all = cut(large, 1e-6);
  // 2 pi / (2 acos(1 - 1e-6 / 90000))
  EXPECT_NEAR(static_cast<double>(all.size()), std::numbers::pi / std::sqrt(2e-6 / 90000), 2);
}

TEST(Chords, need_no_memory) {
  test::CurveDrawer drawer(7);
  for (int kind = 0; kind < test::CurveDrawer::kinds; ++kind) {
    const test::DrawnCurve drawn = drawer.draw(kind);
    std::visit(
        [&](const auto& curve) {
          const std::size_t before = test::allocations;
          Chords chords(curve, within(0.001));
          Chord chord;
          while (chords.next(chord)) continue;
          EXPECT_EQ(test::allocations, before) << drawn.kind;
        },
        drawn.curve);
  }
}

}  // namespace
}  // namespace passo
