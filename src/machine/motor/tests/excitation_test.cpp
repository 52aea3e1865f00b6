#include "passo/motor/excitation.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> patterns(const char* name, int count) {
  std::vector<std::string> found;
  for (int place = 0; place < count; ++place) {
    const WindingState state = Excitation::named(name)->at(place);
    found.emplace_back();
    for (unsigned output = 0; output < 4; ++output) found.back() += state.on(output) ? '1' : '0';
  }
  return found;
}

TEST(Excitation, goes_through_the_patterns_of_the_first_board) {
  EXPECT_THAT(patterns("two-on", 5), ElementsAre("1100", "0110", "0011", "1001", "1100"));
  EXPECT_THAT(patterns("wave", 4), ElementsAre("1000", "0100", "0010", "0001"));
  EXPECT_THAT(patterns("half-step", 8), ElementsAre("1100", "0100", "0110", "0010", "0011", "0001", "1001", "1000"));
  EXPECT_THAT(patterns("microsteps:2", 8), ElementsAre("1100", "0100", "0110", "0010", "0011", "0001", "1001", "1000"));
}

// The angle of the field, in quarters of a turn of the current.
double field(const WindingState& state) {
  return std::atan2(state.phase_b, state.phase_a) / (std::numbers::pi / 2);
}

TEST(Excitation, turns_the_field_by_the_same_angle_at_every_step_up_and_down) {
  for (const char* name : {"two-on", "wave", "half-step", "microsteps:2", "microsteps:16", "microsteps:256"}) {
    const Excitation excitation = *Excitation::named(name);
    for (std::int64_t place = -1100; place < 1100; ++place) {
      const double turned = field(excitation.at(place + 1)) - field(excitation.at(place));
      ASSERT_NEAR(std::remainder(turned, 4), 1.0 / excitation.steps_per_full_step(), 1e-9) << name << " " << place;
    }
  }
}

TEST(Excitation, has_the_current_that_its_name_says) {
  const auto square = [](const WindingState& state) {
    return state.phase_a * state.phase_a + state.phase_b * state.phase_b;
  };
  for (std::int64_t place = 0; place < 64; ++place) {
    EXPECT_EQ(square(Excitation::named("two-on")->at(place)), 2);  // twice the power of wave, √2 times the torque
    EXPECT_EQ(square(Excitation::named("wave")->at(place)), 1);
    EXPECT_EQ(square(Excitation::named("half-step")->at(place)), place % 2 == 0 ? 2 : 1);
    EXPECT_NEAR(square(Excitation::named("microsteps:16")->at(place)), 1, 1e-12);
  }
}

TEST(Excitation, turns_the_rotor_by_a_full_step_in_as_many_steps_as_it_makes_of_one) {
  EXPECT_EQ(Excitation::named("wave")->rotor_degrees(-3, 200), -5.4);
  EXPECT_EQ(Excitation::named("half-step")->rotor_degrees(2, 200), 1.8);
  EXPECT_EQ(Excitation::named("microsteps:16")->rotor_degrees(3200, 200), 360);
}

TEST(Excitation, without_a_name_says_what_was_expected) {
  for (const char* name :
       {"", "full", "microsteps", "microsteps:", "microsteps:1", "microsteps:257", "microsteps:4x"}) {
    EXPECT_THAT(Excitation::named(name).error(), HasSubstr("two-on, wave, half-step or microsteps:N")) << name;
  }
}

}  // namespace
}  // namespace passo
