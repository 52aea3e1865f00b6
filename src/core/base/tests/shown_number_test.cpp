// Numbers and counts as messages show them.
#include <gtest/gtest.h>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"

namespace passo {
namespace {

TEST(SensibleNumber, has_six_digits_and_all_before_the_point) {
  EXPECT_EQ(sensible_number(285.459858584443), "285.46");
  EXPECT_EQ(sensible_number(280), "280");
  EXPECT_EQ(sensible_number(1e5), "100000");
  EXPECT_EQ(sensible_number(1234567.891), "1234568");
  EXPECT_EQ(sensible_number(16e6), "16000000");
  EXPECT_EQ(sensible_number(-187042312.141715), "-187042312");
  EXPECT_EQ(sensible_number(0.00123456789), "0.00123457");
  EXPECT_EQ(sensible_number(0), "0");
  EXPECT_EQ(sensible_number(1.5e-5), "1.5e-05");
  EXPECT_EQ(sensible_number(1e20), "1e+20");
  EXPECT_EQ(sensible_number(99999.9, 4), "100000");
  EXPECT_EQ(sensible_number(33.33333, 4), "33.33");
}

TEST(Counted, has_the_noun_in_its_number) {
  EXPECT_EQ(counted(std::uint64_t{0}, "tool"), "0 tools");
  EXPECT_EQ(counted(std::uint64_t{1}, "tool"), "1 tool");
  EXPECT_EQ(counted(std::uint64_t{1234}, "tool"), "1 234 tools");
  EXPECT_EQ(counted(std::uint64_t{1}, "entry", "entries"), "1 entry");
  EXPECT_EQ(counted(std::uint64_t{2}, "entry", "entries"), "2 entries");
}

}  // namespace
}  // namespace passo
