#include "passo/geometry/step_chords.hpp"

#include "drawn_curves.hpp"
#include "kit/seed.hpp"

namespace passo {
namespace {

using test::Real;

std::array<Real, 3> exact_steps(const Vector3& place, const StepScale& scale) {
  return {Real(place.x) * scale.steps_per_mm[0], Real(place.y) * scale.steps_per_mm[1],
          Real(place.z) * scale.steps_per_mm[2]};
}

TEST(RandomStepChords, add_up_to_the_rounded_end_and_stay_within_half_a_step) {
  const std::uint64_t seed = test::seed();
  test::CurveDrawer drawer(seed);
  for (int n = 0; n < 1400; ++n) {
    const test::DrawnCurve drawn = drawer.draw(n);
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << seed << " curve " << n << ", " << drawn.kind);
    const ChordTolerance tolerance = *ChordTolerance::of(Mm(std::exp(drawer.between(-8, 0))));
    const auto some = [&] { return std::exp(drawer.between(-1, 7)); };
    const StepScale scale{{some(), some(), some()}};
    std::visit(
        [&](const auto& curve) {
          const ParameterRange range = curve.range();
          const Vector3 start = curve.at(range.low);
          Chords chords(curve, tolerance);
          StepChords steps(chords, start, scale);
          std::array<std::int64_t, 3> sum{};
          for (std::size_t i = 0; i < 3; ++i) sum[i] = std::llround(exact_steps(start, scale)[i]);
          double reached = range.low;
          for (StepChord chord; steps.next(chord);) {
            const std::array<Real, 3> wanted = exact_steps(curve.at(chord.chord.to), scale);
            bool moves = false;
            ASSERT_EQ(chord.chord.from, reached);
            reached = chord.chord.to;
            for (std::size_t i = 0; i < 3; ++i) {
              moves = moves || chord.distances[i] != 0;
              sum[i] += chord.distances[i];
              ASSERT_EQ(sum[i], chord.end[i].count);
              ASSERT_LE(std::abs(static_cast<Real>(sum[i]) - wanted[i]), 0.5L + 1e-9L);
            }
            ASSERT_TRUE(moves);
          }
          ASSERT_FALSE(steps.error().has_value());
          const std::array<Real, 3> end = exact_steps(curve.at(range.high), scale);
          for (std::size_t i = 0; i < 3; ++i) {
            ASSERT_EQ(sum[i], std::llround(static_cast<double>(end[i])));
            ASSERT_EQ(sum[i], steps.place()[i].count);
          }
        },
        drawn.curve);
  }
}

// A relief of ten thousand chords that each end at a third of a step. Rounding their lengths one by one would lose all.
TEST(StepChords, lose_nothing_of_chords_that_are_shorter_than_a_step) {
  class Thirds final : public Source<Chord> {
   public:
    bool next(Chord& chord) override {
      if (made_ == 10'000) return false;
      ++made_;
      chord.end = {made_ / 3.0, -made_ / 3.0, 0};
      return true;
    }

   private:
    int made_ = 0;
  };
  Thirds thirds;
  StepChords steps(thirds, {}, {});
  std::int64_t sum = 0;
  int chords = 0;
  for (StepChord chord; steps.next(chord); ++chords) {
    EXPECT_EQ(chord.distances[0], 1);
    EXPECT_EQ(chord.distances[1], -1);
    sum += chord.distances[0];
  }
  EXPECT_EQ(sum, 3333);
  EXPECT_EQ(chords, 3333);
}

TEST(StepChords, round_halves_away_from_zero) {
  const auto x = [](double mm) { return (*to_steps({mm, 0, 0}, {}))[0].count; };
  EXPECT_EQ(x(0.5), 1);
  EXPECT_EQ(x(-0.5), -1);
  EXPECT_EQ(x(2.5), 3);
  EXPECT_EQ(x(-2.4999), -2);
}

TEST(StepChords, say_where_the_range_of_steps_ends) {
  const auto outcome = [](double mm, double steps_per_mm) -> std::string {
    const auto curve = CurveInSpace::of(Curve::line(Point{}, Point{{.values = {0, mm}}}));
    Chords chords(*curve, *ChordTolerance::of(Mm(1)));
    StepChords steps(chords, {}, {{1, steps_per_mm, 1}});
    StepChord chord;
    const bool moved = steps.next(chord);
    EXPECT_EQ(moved, !steps.error().has_value());
    return moved ? std::to_string(chord.distances[1]) : steps.error()->message;
  };
  EXPECT_EQ(outcome(2147.483647, 1e6), "2147483647");
  EXPECT_EQ(outcome(-2147.483647, 1e6), "-2147483647");
  EXPECT_EQ(outcome(2147.483648, 1e6), "a chord is longer than 2147483647 steps on Y");
  EXPECT_EQ(outcome(-2147.483648, 1e6), "a chord is longer than 2147483647 steps on Y");
  EXPECT_EQ(outcome(1, 1e18), "a position on Y is more than 2^52 steps from zero");
  EXPECT_EQ(outcome(1, 0), "the scale of Y must be above 0 steps/mm");
}

}  // namespace
}  // namespace passo
