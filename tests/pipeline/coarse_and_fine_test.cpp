// Both levels of interpolation together: a curve is cut into chords, and a line method walks along each of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "kit/seed.hpp"

#include "passo/geometry/bezier.hpp"
#include "passo/geometry/nurbs.hpp"
#include "passo/geometry/step_chords.hpp"
#include "passo/interpolate/bresenham_line.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/master_slave.hpp"
#include "passo/interpolate/point_comparison_line.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"

namespace passo {
namespace {

constexpr double steps_per_mm = 80;
const StepScale scale{{steps_per_mm, steps_per_mm, steps_per_mm}};

struct Walked {
  StepPlace place = {};
  double farthest = 0;  // steps from the curve
  std::size_t pulses = 0;
};

// The distance of a step from a stretch of the curve, sampled finely.
template <class C>
double steps_from(const C& curve, const Chord& chord, const StepPlace& place) {
  double nearest = 1e30;
  for (int k = 0; k <= 200; ++k) {
    const Vector3 at = curve.at(chord.from + (chord.to - chord.from) * k / 200) * steps_per_mm;
    nearest = std::min(
        nearest, std::hypot(at.x - static_cast<double>(place[0].count), at.y - static_cast<double>(place[1].count),
                            at.z - static_cast<double>(place[2].count)));
  }
  return nearest;
}

template <std::uint8_t axes, class Fine, class C>
Walked walk(const C& curve, double tolerance) {
  const Vector3 start = curve.at(curve.range().low);
  Chords chords(curve, *ChordTolerance::of(Mm(tolerance)));
  StepChords step_chords(chords, start, scale);
  Walked walked{.place = step_chords.place()};
  for (StepChord chord; step_chords.next(chord);) {
    std::int32_t distances[axes];  // NOLINT: as the line methods take it
    std::copy_n(chord.distances, axes, distances);
    Fine fine(distances);
    while (!fine.done()) {
      const Pulse pulse = fine.next();
      for (std::uint8_t axis = 0; axis < axes; ++axis) {
        if ((pulse.steps >> axis & 1) != 0) walked.place[axis].count += (pulse.directions >> axis & 1) != 0 ? -1 : 1;
      }
      if (walked.pulses++ % 7 == 0) {
        walked.farthest = std::max(walked.farthest, steps_from(curve, chord.chord, walked.place));
      }
    }
    EXPECT_EQ(walked.place, chord.end);
  }
  EXPECT_FALSE(step_chords.error().has_value());
  return walked;
}

class CoarseAndFine : public testing::Test {
 protected:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vector3 place(bool flat) { return {between(-10, 10), between(-10, 10), flat ? 0 : between(-10, 10)}; }

  // Both ends of a chord are half a step an axis beside the curve at most, and the line method adds its own.
  template <std::uint8_t axes, class Fine, class C>
  void expect_to_follow(const C& curve, double tolerance, double own_error) {
    const Walked walked = walk<axes, Fine>(curve, tolerance);
    EXPECT_EQ(walked.place, *to_steps(curve.at(curve.range().high), scale));
    EXPECT_LE(walked.farthest, tolerance * steps_per_mm + std::sqrt(axes) * (0.5 + own_error) + 0.1);
    EXPECT_GT(walked.pulses, 0U);
  }

  std::uint64_t seed_ = test::seed();
  std::mt19937_64 random_{seed_};
};

TEST_F(CoarseAndFine, any_method_for_lines_in_space_follows_any_curve_to_its_very_end) {
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " curve " << n);
    const double tolerance = std::exp(between(-6, 0));
    const CubicBezier cubic = *CubicBezier::create({place(false), place(false), place(false), place(false)});
    std::vector<Vector3> control(7);
    std::ranges::generate(control, [&] { return place(false); });
    const Nurbs spline =
        *Nurbs::create({.degree = 3, .control = control, .weights = {1, 2, 1, 3, 1, 2, 1}, .knots = {}});
    const auto follow = [&](const auto& curve) {
      expect_to_follow<3, BresenhamLine<3>>(curve, tolerance, 0.5);
      expect_to_follow<3, MasterSlave<3>>(curve, tolerance, 0.5);
      expect_to_follow<3, Dda<3>>(curve, tolerance, 1);
    };
    follow(cubic);
    follow(spline);
  }
}

TEST_F(CoarseAndFine, any_method_for_two_axes_follows_any_flat_curve_to_its_very_end) {
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed_ << " curve " << n);
    const double tolerance = std::exp(between(-6, 0));
    const QuadraticBezier curve = *QuadraticBezier::create({place(true), place(true), place(true)});
    expect_to_follow<2, SlopeRecalculated<>>(curve, tolerance, 1);
    expect_to_follow<2, PointComparisonLine<>>(curve, tolerance, 1);
    // Falls behind by many steps within a long line; the end of each chord takes that back.
    const Walked walked = walk<2, SlopeBlocks<>>(curve, tolerance);
    EXPECT_EQ(walked.place, *to_steps(curve.at(1), scale));
  }
}

}  // namespace
}  // namespace passo
