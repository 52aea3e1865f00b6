#include "../decimal_text.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using Room = std::array<char, longest_decimal_text>;

std::string four(double value) {
  Room room;
  return {room.data(), write_decimal_4(room.data(), value)};
}
std::string six(double value) {
  Room room;
  return {room.data(), write_decimal_6(room.data(), value)};
}

void expect_as_printf(double value) {
  EXPECT_EQ(four(value), fmt::format("{:.4f}", value)) << fmt::format("{:a}", value);
  EXPECT_EQ(six(value), fmt::format("{:.6f}", value)) << fmt::format("{:a}", value);
}

TEST(DecimalText, numbers_are_the_characters_of_printf) {
  for (const double value :
       {0.0,  -0.0,    1.0,        -1.0,        0.00005,       0.00015,    0.00025,           0.03125,        0.15625,
        2.5,  9.99995, 9.99994999, 99999.99995, 1e10,          1e11,       99999999999.99996, 123456789012.3, 1e15,
        1e22, 1e300,   5e-324,     0.1 + 0.2,   1e9 + 0.00005, -0.00004999})
    expect_as_printf(value), expect_as_printf(-value);
  expect_as_printf(std::numeric_limits<double>::max());
}

// Halves are where a product that is rounded leads the wrong way.
TEST(DecimalText, numbers_beside_a_half_are_rounded_as_printf_does) {
  for (int i = 0; i < 20'000; ++i) {
    const double half = (i + 0.5) / 10'000;
    for (const double value : {half, std::nextafter(half, 0), std::nextafter(half, 1e9), half / 100, half * 1e6})
      expect_as_printf(value);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(DecimalText, random_numbers_are_the_characters_of_printf) {
  std::mt19937_64 random(test::seed());
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  for (int i = 0; i < test::fewer(40'000); ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) expect_as_printf(value);
    expect_as_printf(std::uniform_real_distribution<double>(-2000, 2000)(random));
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(DecimalText, whole_numbers_have_all_their_digits) {
  for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{9}, std::uint64_t{10}, std::uint64_t{99},
                                    std::uint64_t{100}, std::uint64_t{12345}, ~std::uint64_t{0}}) {
    Room room;
    EXPECT_EQ(std::string(room.data(), write_whole(room.data(), value)), std::to_string(value));
  }
}

}  // namespace
}  // namespace passo
