// The faulty listings as methods: on which moves they are wrong, and how. The oracle is arithmetic on the move, not the
// right method.
#include "passo/study/faulty_listing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/study/measure.hpp"

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

StepMove to(Place end) {
  return {.from = Place(end.size(), 0), .to = end, .arc = {}};
}

ListingCheck checked(MethodName name, const StepMove& move) {
  auto check = check_listing({.name = name}, move);
  EXPECT_TRUE(check) << check.error();
  return std::move(*check);
}

TEST(FaultyListings, rounding_in_doubles_misses_ties_only) {
  const StepMove tie = to({22, 15});
  const ListingCheck found = checked(MethodName::listing_rounding, tie);
  EXPECT_EQ(found.first_wrong(), 11);
  EXPECT_EQ(found.wrong(), 2);  // the step that is missing at 11 comes at 12
  EXPECT_EQ(found.place(), tie.to);
  EXPECT_EQ(found.describe(),
            "pulse 11 is the first wrong one; wrong are 2 of 22 pulses; it ends at (22, 15), as it should");
  int wrong_lines = 0;
  for (std::int64_t m = 1; m <= 100; ++m) {
    for (std::int64_t s = 0; s <= m; ++s) {
      const StepMove move = to({m, -s});
      const ListingCheck check = checked(MethodName::listing_rounding, move);
      ASSERT_EQ(check.place(), move.to);
      if (check.wrong() == 0) continue;
      ++wrong_lines;
      ASSERT_EQ(2 * check.first_wrong() * s % (2 * m), m) << m << " " << s << ": only a tie is missed";
    }
  }
  EXPECT_EQ(wrong_lines, 54);
}

TEST(FaultyListings, the_shared_variable_of_two_axes_ends_a_step_too_far_on_every_line) {
  for (std::int64_t m = 1; m <= 40; ++m) {
    for (std::int64_t s = 1; s < m; ++s) {
      const StepMove move = to({m, s});
      const ListingCheck check = checked(MethodName::listing_shared_variable, move);
      ASSERT_THAT(check.place(), ElementsAre(m, s + 1));
      // The variable is 2m too large, which is one step of the slave: it comes at the first pulse that should have
      // none.
      std::int64_t without = 1;
      while ((2 * without * s + m) / (2 * m) != (2 * (without - 1) * s + m) / (2 * m)) ++without;
      ASSERT_EQ(check.first_wrong(), without);
      ASSERT_EQ(check.wrong(), 1);
    }
  }
  const StepMove ten = to({10, 4});
  EXPECT_EQ(checked(MethodName::listing_shared_variable, ten).describe(),
            "pulse 1 is the first wrong one; wrong are 1 of 10 pulses; it ends at (10, 5) instead of (10, 4)");
}

TEST(FaultyListings, the_shared_variable_of_three_axes_mixes_them_up) {
  const StepMove move = to({10, 4, 7});
  const ListingCheck check = checked(MethodName::listing_shared_variable, move);
  EXPECT_NE(check.place(), move.to);
  EXPECT_GT(check.wrong(), 1);
}

TEST(FaultyListings, slope_in_blocks_is_right_up_to_slope_one_and_wrong_above_it) {
  for (std::int64_t x = 1; x <= 40; ++x) {
    for (std::int64_t y = 1; y <= 40; ++y) {
      const StepMove move = to({x, -y});
      const ListingCheck check = checked(MethodName::listing_slope_blocks, move);
      if (y <= x) {
        ASSERT_EQ(check.wrong(), 0) << x << " " << y;
        ASSERT_EQ(check.place(), move.to);
      } else {
        // x blocks of y div x pulses; x mod y, which is x, extra steps of X.
        ASSERT_THAT(check.place(), ElementsAre(2 * x, -(y / x) * x)) << x << " " << y;
      }
    }
  }
  const StepMove steep = to({3, 29});
  const ListingCheck found = checked(MethodName::listing_slope_blocks, steep);
  EXPECT_THAT(found.place(), ElementsAre(6, 27));
  EXPECT_EQ(found.first_wrong(), 10);  // the extra step of the first block is one of X
}

TEST(FaultyListings, projection_fails_at_45_degrees_and_where_x_does_not_move) {
  for (std::int64_t x = 0; x <= 30; ++x) {
    for (std::int64_t y = 0; y <= 30; ++y) {
      if (x == 0 && y == 0) continue;
      const StepMove move = to({-x, y});
      const ListingCheck check = checked(MethodName::listing_projection, move);
      if (x == y) {
        ASSERT_THAT(check.place(), ElementsAre(-x, y - 1));
        ASSERT_EQ(check.wrong(), 0);
        ASSERT_EQ(check.first_wrong(), 2 * x) << "the last pulse is missing";
      } else if (x == 0) {
        ASSERT_THAT(check.place(), ElementsAre(1, y)) << "F = 0 feeds X, although it has no steps";
        ASSERT_EQ(check.first_wrong(), 1);
      } else {
        ASSERT_EQ(check.place(), move.to);
        ASSERT_EQ(check.wrong(), 0);
      }
    }
  }
}

TEST(FaultyListings, are_no_methods_for_a_move_but_have_names) {
  for (const char* name :
       {"listing:rounding", "listing:shared-variable", "listing:slope-blocks", "listing:projection"}) {
    ASSERT_TRUE(method_named(name)) << name;
    ASSERT_TRUE(right_method_of({.name = *method_named(name)})) << name;
  }
  for (const Method& method : methods_for(to({9, 4}))) EXPECT_FALSE(right_method_of(method)) << title(method);
}

TEST(FaultyListings, that_do_not_take_a_move_say_why) {
  const auto refusal = [](MethodName name, const StepMove& move) { return start({.name = name}, move).error(); };
  EXPECT_THAT(refusal(MethodName::listing_slope_blocks, to({5, 0})), HasSubstr("divides by zero"));
  EXPECT_THAT(refusal(MethodName::listing_projection, to({5, 1, 1})), HasSubstr("two axes"));
  EXPECT_THAT(refusal(MethodName::listing_rounding, to({1'000'001, 1})), HasSubstr("at most 1000000 steps"));
  const StepMove arc{.from = {5, 0}, .to = {0, 5}, .arc = StepMove::Arc{.centre = {0, 0}}};
  EXPECT_THAT(refusal(MethodName::listing_rounding, arc), HasSubstr("for lines"));
}

}  // namespace
}  // namespace passo
