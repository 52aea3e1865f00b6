#include "passo/geometry/equal_chords.hpp"

#include "drawn_curves.hpp"
#include "kit/seed.hpp"

namespace passo {
namespace {

template <class C>
std::vector<Chord> equal_chords(const C& curve, double length) {
  EqualChords chords(curve, *ChordLength::of(Mm(length)));
  std::vector<Chord> all;
  for (Chord chord; chords.next(chord);) all.push_back(chord);
  return all;
}

TEST(EqualChords, of_an_arc_have_the_sagitta_of_the_handbook) {
  const Ellipse circle = *Ellipse::flat({0, 0, 0}, Mm(10), Mm(10), {0}, {0}, {1.5707963267948966});
  const std::vector<Chord> all = equal_chords(circle, 1);
  ASSERT_EQ(all.size(), 16U);  // a chord of 1 mm turns by 2 asin(0.05) = 5.732 degrees: 15.7 of them
  Vector3 before = circle.at(circle.range().low);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    EXPECT_NEAR(length(all[i].end - before), 1, 1e-12);
    EXPECT_NEAR(all[i].deviation.value(), 10 - std::sqrt(100 - 0.25), 1e-9);  // r − √(r² − L²/4), about L²/8r = 0.0125
    before = all[i].end;
  }
  EXPECT_LT(length(all.back().end - before), 1);
  EXPECT_EQ(all.back().end, circle.at(circle.range().high));
}

TEST(EqualChords, longer_than_the_curve_are_one_chord) {
  const CubicBezier curve = *CubicBezier::create({Vector3{0, 0, 0}, {1, 1, 0}, {2, 1, 0}, {3, 0, 0}});
  const std::vector<Chord> all = equal_chords(curve, 50);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].end, (Vector3{3, 0, 0}));
}

TEST(EqualChords, of_a_circle_that_is_smaller_than_the_chord_tell_that_they_do_not_follow) {
  const Ellipse circle = *Ellipse::flat({0, 0, 0}, Mm(5), Mm(5), {0}, {0}, {6.283185307179586});
  EXPECT_FALSE(std::isfinite(equal_chords(circle, 30)[0].deviation.value()));
}

TEST(RandomEqualChords, have_equal_lengths_and_bound_the_curve_between_their_ends) {
  const std::uint64_t seed = test::seed();
  test::CurveDrawer drawer(seed);
  for (int n = 0; n < 140; ++n) {
    const test::DrawnCurve drawn = drawer.draw(n);
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed << " curve " << n << ", " << drawn.kind);
    std::visit(
        [&](const auto& curve) {
          const double low = curve.range().low;
          double way = 0;
          for (int i = 0; i < 200; ++i) {
            const double step = (curve.range().high - low) / 200;
            way += length(curve.at(low + (i + 1) * step) - curve.at(low + i * step));
          }
          if (way < 1e-3) return;
          const double wanted = way / 37;
          const std::vector<Chord> all = equal_chords(curve, wanted);
          Vector3 before = curve.at(low);
          for (std::size_t i = 0; i < all.size(); ++i) {
            if (i + 1 < all.size()) {
              ASSERT_NEAR(length(all[i].end - before) / wanted, 1, 1e-6);
            }
            for (int k = 0; k <= 20; ++k) {
              const Vector3 place = curve.at(all[i].from + (all[i].to - all[i].from) * k / 20);
              ASSERT_LE(length(place - nearest_of(before, all[i].end, place)),
                        all[i].deviation.value() * (1 + 1e-9) + 1e-9);
            }
            before = all[i].end;
          }
          EXPECT_EQ(all.back().end, curve.at(curve.range().high));
          EXPECT_LE(all.size(), 60U);
          // Chords that are too long for the curve cut off whole turns, and say so.
          const bool follows =
              std::ranges::all_of(all, [](const Chord& c) { return std::isfinite(c.deviation.value()); });
          EXPECT_TRUE(all.size() >= 10 || !follows) << all.size();
        },
        drawn.curve);
  }
}

}  // namespace
}  // namespace passo
