#include "passo/study/curve_pulses.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/geometry/bezier.hpp"
#include "passo/geometry/ellipse.hpp"
#include "passo/geometry/equal_chords.hpp"
#include "passo/geometry/nurbs.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

const StepScale scale{{20, 20, 20}};

struct Walked {
  StepPlace end;
  CurveMeasures measures;
  std::optional<std::string> error;
};

template <ParametricCurve C>
Walked walk(const C& curve, Source<Chord>& chords, const Method& method) {
  CurvePulses pulses([&](double u) { return curve.at(u); }, curve.range(), chords, scale, method);
  StepPlace place = pulses.start();
  for (CurvePulse pulse; pulses.next(pulse);) {
    for (std::size_t axis = 0; axis < space_axes; ++axis) {
      if ((pulse.pulse.steps >> axis & 1) == 0) continue;
      place[axis].count += (pulse.pulse.directions >> axis & 1) != 0 ? -1 : 1;
    }
    EXPECT_EQ(place, pulse.place);
  }
  return {.end = place, .measures = pulses.measures(), .error = pulses.error()};
}

// The tolerance, half a step on each axis for the rounded ends (√½ across), and the method's own error.
double most(const Method& method, double tolerance) {
  const double own = method.name == MethodName::lean || method.name == MethodName::master_slave ? 0.5 : 1;
  return tolerance + (std::sqrt(0.5) + own) / 20;
}

template <ParametricCurve C>
void check_all_methods(const C& curve) {
  constexpr double tolerance = 0.05;
  const Vector3 end = curve.at(curve.range().high);
  const StepPlace expected = *to_steps(end, scale);
  for (const MethodName name : {MethodName::master_slave, MethodName::lean, MethodName::dda,
                                MethodName::slope_recalculated, MethodName::point_comparison}) {
    const Method method{.name = name};
    Chords chords(curve, *ChordTolerance::of(Mm(tolerance)));
    const Walked walked = walk(curve, chords, method);
    EXPECT_FALSE(walked.error);
    EXPECT_EQ(walked.end, expected);
    EXPECT_GT(walked.measures.chords, 3);
    EXPECT_LE(walked.measures.largest_deviation, Mm(most(method, tolerance))) << title(method);
    EXPECT_GT(walked.measures.largest_deviation, walked.measures.mean_deviation);
  }
}

TEST(CurvePulses, follow_an_ellipse_a_parabola_and_a_spline_by_any_line_method_to_the_very_end) {
  check_all_methods(*Ellipse::flat({0, 0, 0}, Mm(20), Mm(8), {0.4}, {0}, {6.283185307179586}));
  check_all_methods(*parabola({0, 0, 0}, {0, 5, 0}, Mm(-12), Mm(20)));
  check_all_methods(*Nurbs::create({.degree = 3,
                                    .control = {{0, 0, 0}, {5, 10, 0}, {10, -10, 0}, {15, 10, 0}, {20, 0, 0}},
                                    .weights = {},
                                    .knots = {}}));
}

TEST(CurvePulses, of_a_straight_line_are_the_pulses_of_the_line) {
  const CubicBezier straight = *CubicBezier::create({Vector3{0, 0, 0}, {0.1, 0.04, 0}, {0.3, 0.12, 0}, {0.5, 0.2, 0}});
  Chords chords(straight, *ChordTolerance::of(Mm(0.001)));
  const Walked walked = walk(straight, chords, {.name = MethodName::point_comparison});
  EXPECT_EQ(walked.measures.pulses, 14);
  EXPECT_EQ(walked.measures.together, 0);
}

TEST(CurvePulses, say_what_is_wrong) {
  const CubicBezier up = *CubicBezier::create({Vector3{0, 0, 0}, {1, 2, 3}, {3, 2, 3}, {5, 0, 9}});
  Chords chords(up, *ChordTolerance::of(Mm(0.01)));
  EXPECT_THAT(*walk(up, chords, {.name = MethodName::slope_blocks}).error,
              HasSubstr("two axes, but the curve moves Z"));
  Chords again(up, *ChordTolerance::of(Mm(0.01)));
  EXPECT_THAT(*walk(up, again, {.name = MethodName::midpoint}).error, HasSubstr("for arcs"));
  const Ellipse most_of_a_circle = *Ellipse::flat({0, 0, 0}, Mm(5), Mm(5), {0}, {0}, {5});
  EqualChords coarse(most_of_a_circle, *ChordLength::of(Mm(30)));
  EXPECT_THAT(*walk(most_of_a_circle, coarse, {.name = MethodName::lean}).error, HasSubstr("too large an angle"));
}

}  // namespace
}  // namespace passo
