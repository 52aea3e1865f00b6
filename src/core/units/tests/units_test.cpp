#include "passo/units/units.hpp"

#include <type_traits>

namespace passo {
namespace {

TEST(Units, dividing_a_length_by_a_time_gives_a_speed) {
  static_assert(std::is_same_v<decltype(Mm(1) / Seconds(1)), MmPerSecond>);
  static_assert(std::is_same_v<decltype(MmPerSecond(1) / Seconds(1)), MmPerSecond2>);
  static_assert(std::is_same_v<decltype(Seconds(1) * Hertz(1)), double>);
  EXPECT_EQ((Mm(10) / Seconds(4)).value(), 2.5);
}

TEST(Units, a_quotient_of_equal_units_is_a_plain_number) {
  static_assert(std::is_same_v<decltype(Mm(1) / Mm(1)), double>);
  EXPECT_EQ(Mm(10) / Mm(4), 2.5);
}

TEST(Units, unlike_units_do_not_mix) {
  static_assert(!std::is_convertible_v<Mm, Seconds>);
  static_assert(!std::is_convertible_v<double, Mm>);
  static_assert(sizeof(Mm) == sizeof(double));
}

}  // namespace
}  // namespace passo
