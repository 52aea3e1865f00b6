#include <cmath>
#include <cstdlib>
#include <random>

#include "kit/seed.hpp"
#include "parsed_line.hpp"

namespace passo {
namespace {

double number(const std::string& digits) {
  const ParsedLine line("X" + digits);
  EXPECT_TRUE(line.good) << digits.substr(0, 100) << ": " << render(line.diagnostics, false);
  return line.good ? line.value() : std::nan("");
}

TEST(Numbers, take_a_sign_and_a_decimal_point_anywhere) {
  EXPECT_EQ(number("12"), 12);
  EXPECT_EQ(number("+12.5"), 12.5);
  EXPECT_EQ(number("-12.5"), -12.5);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("-.25"), -0.25);
  EXPECT_EQ(number("007"), 7);
}

TEST(Numbers, may_have_blanks_inside_as_the_standard_has_it) {
  const ParsedLine line("g 0x +0. 12 34Y\t7");
  ASSERT_TRUE(line.good);
  ASSERT_EQ(line.block.words.size(), 3U);
  EXPECT_EQ(line.value(0), 0);
  EXPECT_EQ(line.value(1), 0.1234);
  EXPECT_EQ(line.value(2), 7);
}

TEST(Numbers, keep_the_sign_of_minus_zero) {
  EXPECT_TRUE(std::signbit(number("-0")));
  EXPECT_FALSE(std::signbit(number("0")));
}

TEST(Numbers, have_no_exponent_so_that_e_is_the_next_word) {
  const ParsedLine line("X1E5");
  ASSERT_TRUE(line.good);
  ASSERT_EQ(line.block.words.size(), 2U);
  EXPECT_EQ(line.block.words[1].letter, 'E');
  EXPECT_EQ(line.value(1), 5);
}

TEST(Numbers, round_correctly_where_the_digits_are_more_than_a_double_holds) {
  EXPECT_EQ(number("9007199254740993"), 9007199254740992.0);  // 2^53 + 1: a tie, to even
  EXPECT_EQ(number("9007199254740993.00000000000000000001"), 9007199254740994.0);
  EXPECT_EQ(number("0.1000000000000000055511151231257827"), 0.1);
  EXPECT_EQ(number("123456789012345678901234567890"), 123456789012345678901234567890.0);
}

TEST(Numbers, equal_the_c_librarys_for_random_digits) {
  std::mt19937_64 random(test::seed());
  const auto digits = [&random](int most) {
    std::string text;
    for (int n = static_cast<int>(random() % static_cast<unsigned>(most + 1)); n > 0; --n) {
      text += static_cast<char>('0' + random() % 10);
    }
    return text;
  };
  for (int i = 0; i < 20'000; ++i) {
    const int most = i % 4 == 0 ? 40 : 9;
    std::string text = digits(most);
    if (text.empty() || random() % 2 == 0) text += "." + digits(most) + "5";
    if (random() % 2 == 0) text = '-' + text;
    ASSERT_EQ(number(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Numbers, below_the_smallest_double_are_zero) {
  EXPECT_EQ(number("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(number(std::string(5000, '0') + "." + std::string(20, '0') + "1"), 1e-21);
  EXPECT_EQ(number("0." + std::string(323, '0') + "5"), 5e-324);
}

TEST(Numbers, that_no_double_can_hold_are_refused) {
  EXPECT_EQ(number(std::string(308, '9')), std::strtod(std::string(308, '9').c_str(), nullptr));
  EXPECT_EQ(ParsedLine("G1 X" + std::string(400, '9')).fault_at(), "gcode.number-out-of-range 5 400");
  EXPECT_EQ(ParsedLine("G1 X-" + std::string(400, '9') + ".5").fault_at(), "gcode.number-out-of-range 5 403");
  EXPECT_EQ(ParsedLine("G1 X0." + std::string(2000, '3')).fault_at(), "gcode.number-out-of-range 5 2002");
}

TEST(Numbers, have_one_decimal_point_and_a_digit) {
  EXPECT_EQ(ParsedLine("G1 X1.2.3").fault_at(), "gcode.unexpected-text 8 1");
  EXPECT_EQ(ParsedLine("G1 X.").fault_at(), "gcode.missing-value 5 1");
  EXPECT_EQ(ParsedLine("G1 X- Y1").fault_at(), "gcode.missing-value 5 1");
}

}  // namespace
}  // namespace passo
