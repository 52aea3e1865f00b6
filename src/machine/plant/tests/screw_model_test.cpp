#include "passo/plant/screw_model.hpp"

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/geometry/surface.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

constexpr Seconds no_time{0};

TEST(ScrewModel, a_slide_stands_until_the_backlash_is_taken_up) {
  IdealPlant plant;
  plant.stand_at({100});
  plant.fit_screw(0, {.backlash = 15});
  EXPECT_EQ(plant.events_to_next_change(), 1) << "a sum would hide reversals";
  const auto slide_after = [&](std::int64_t steps) {
    plant.pulse(no_time, {steps});
    return plant.truth_at(no_time).positions[0];
  };
  EXPECT_EQ(slide_after(10), 110) << "the backlash was taken up";
  EXPECT_EQ(slide_after(-14), 110);
  EXPECT_EQ(slide_after(-1), 110);
  EXPECT_EQ(slide_after(-5), 105);
  EXPECT_EQ(slide_after(15), 105);
  EXPECT_EQ(slide_after(1), 106);
}

TEST(ScrewModel, the_sign_of_the_backlash_tells_on_which_side_the_motor_begins) {
  IdealPlant plant;
  plant.fit_screw(0, {.backlash = -15});
  plant.pulse(no_time, {-3});
  EXPECT_EQ(plant.truth_at(no_time).positions[0], -3);
  plant.pulse(no_time, {15});
  EXPECT_EQ(plant.truth_at(no_time).positions[0], -3);
  plant.pulse(no_time, {2});
  EXPECT_EQ(plant.truth_at(no_time).positions[0], -1);
}

TEST(ScrewModel, errors_of_pitch_lie_between_those_given_and_stay_beyond_the_ends) {
  const ScrewModel model{.errors = {{.at = -1000, .off = 0}, {.at = 0, .off = 8}, {.at = 500, .off = -2}}};
  EXPECT_DOUBLE_EQ(model.slide_at(-2000), -2000);
  EXPECT_DOUBLE_EQ(model.slide_at(-500), -496);
  EXPECT_DOUBLE_EQ(model.slide_at(0), 8);
  EXPECT_DOUBLE_EQ(model.slide_at(250), 253);
  EXPECT_DOUBLE_EQ(model.slide_at(700), 698);
}

TEST(ScrewModel, switches_and_the_probe_see_the_slide) {
  IdealPlant plant;
  plant.add(TravelSwitch{.input = input_limit, .motor = 0, .closes_at = -20, .opens_at = -20});
  plant.fit_screw(0, {.backlash = 15});
  plant.pulse(no_time, {-34});
  EXPECT_EQ(plant.inputs_at(no_time), 0);
  plant.pulse(no_time, {-1});
  EXPECT_EQ(plant.inputs_at(no_time), input_limit);
}

// A board that keeps sums back misses no change behind a screw with errors of pitch, or with backlash.
TEST(ScrewModel, sums_up_to_the_next_change_tell_as_much_as_each_pulse) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::int64_t kept = 0;
  for (int trial = 0; trial < 100; ++trial) {
    IdealPlant each;
    each.add(TravelSwitch{.input = input_limit, .motor = 0, .at_high_end = true, .closes_at = 300, .opens_at = 296});
    ScrewModel model{.backlash = trial % 4 == 0 ? 3.5 : 0.0};
    for (int at = -400; at <= 400; at += 100) model.errors.push_back({static_cast<double>(at), (at / 100) % 2 * 0.9});
    each.fit_screw(0, model);
    IdealPlant sums = each;
    std::int64_t sum = 0;
    std::int64_t quiet = sums.events_to_next_change();
    std::int64_t way = 1;
    for (int event = 0; event < 3000; ++event) {
      if (random() % 200 == 0) way = -way;
      each.pulse(no_time, {way});
      sum += way;
      if (--quiet == 0) {
        sums.pulse(no_time, {sum});
        sum = 0;
        quiet = sums.events_to_next_change();
      } else {
        ++kept;
      }
      ASSERT_EQ(each.inputs_at(no_time), sums.inputs_at(no_time)) << "event " << event << " of trial " << trial;
    }
    sums.pulse(no_time, {sum});
    EXPECT_NEAR(each.truth_at(no_time).positions[0], sums.truth_at(no_time).positions[0], 1e-9);
  }
  EXPECT_GT(kept, 0);
}

// Five pits and hills. The motor of X has 3 steps to the millimetre, that of Z 5, the other way round.
TEST(TouchSurface, sums_up_to_the_next_change_tell_as_much_as_each_pulse) {
  std::vector<SurfaceTriangle> triangles;
  for (int x = -50; x < 50; x += 10) {
    const auto at = [](int place) { return SurfacePoint{place * 1.0, 0, place / 10 % 2 * 20.0}; };
    const SurfacePoint far{x + 5.0, 40, 0};
    triangles.push_back({at(x), at(x + 10), far});
  }
  const auto surface = std::make_shared<const Surface>(std::move(triangles));
  std::mt19937_64 random(test::seed());
  std::int64_t kept = 0;
  int touched = 0;
  for (int trial = 0; trial < 50; ++trial) {
    IdealPlant each;
    each.add(
        TouchSurface(surface, {{{.motor = 0, .steps_per_mm = 3}, {}, {.motor = 2, .steps_per_mm = -5, .zero = 1}}}));
    each.stand_at({-140, 0, -150});
    IdealPlant sums = each;
    MotorSteps sum{};
    std::int64_t quiet = sums.events_to_next_change();
    for (int event = 0; event < 4000; ++event) {
      const MotorSteps pulse{event % 4 != 0 ? 0 : 1, 0, random() % 16 < (event / 500 % 2 == 0 ? 10U : 6U) ? 1 : -1};
      each.pulse(no_time, pulse);
      for (std::size_t m = 0; m < pulse.size(); ++m) sum[m] += pulse[m];
      if (--quiet == 0) {
        sums.pulse(no_time, std::exchange(sum, {}));
        quiet = sums.events_to_next_change();
      } else {
        ++kept;
      }
      touched += each.inputs_at(no_time) != 0 ? 1 : 0;
      ASSERT_EQ(each.inputs_at(no_time), sums.inputs_at(no_time)) << "event " << event << " of trial " << trial;
    }
  }
  EXPECT_GT(kept, 10'000);
  EXPECT_GT(touched, 1000);
}

}  // namespace
}  // namespace passo
