#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "kit/seed.hpp"
#include "parsed_line.hpp"

namespace passo {
namespace {

using Kind = EvaluationError::Kind;

double value(const std::string& expression) {
  ParsedLine line("X[" + expression + "]");
  EXPECT_TRUE(line.good) << expression << ": " << render(line.diagnostics, false);
  if (!line.good) return std::nan("");
  line.parameters.numbers = {{1, 10}, {2, 1}, {3, 2.5}};
  const Evaluation result = line.evaluation(line.block.words[0].value);
  EXPECT_TRUE(result) << expression;
  return result ? *result : std::nan("");
}

// The error of an expression that cannot be computed, and the columns to point at.
std::string failure(const std::string& expression, Kind kind, double operand) {
  ParsedLine line("X[" + expression + "]");
  EXPECT_TRUE(line.good) << expression;
  line.parameters.numbers = {{1, 10}};
  const Evaluation result = line.evaluation(line.block.words.at(0).value);
  EXPECT_FALSE(result) << expression;
  if (result) return "";
  EXPECT_EQ(static_cast<int>(result.error().kind), static_cast<int>(kind)) << expression;
  EXPECT_EQ(result.error().operand, operand) << expression;
  return line.text.substr(result.error().span.column - 1, result.error().span.length);
}

// The values in these tests were checked against LinuxCNC 2.9's rs274 with (PRINT,...).
TEST(Expressions, bind_as_in_linuxcnc) {
  EXPECT_EQ(value("2 - 3 * 4 / 5"), 2 - 2.4);
  EXPECT_EQ(value("2**3**2"), 64);
  EXPECT_EQ(value("-2**2"), 4);
  EXPECT_EQ(value("2*-3"), -6);
  EXPECT_EQ(value("1--2"), 3);
  EXPECT_EQ(value("10-3-2"), 5);
  EXPECT_EQ(value("1 or 0 and 0"), 0);  // from the left, one precedence
  EXPECT_EQ(value("1 eq 1 and 1"), 1);
  EXPECT_EQ(value("1 lt 2 eq 1"), 1);
  EXPECT_EQ(value("1+1 gt 1"), 1);
  EXPECT_EQ(value("[1+2]*[3+4]"), 21);
}

TEST(Expressions, divide_with_a_remainder_that_is_never_negative) {
  EXPECT_EQ(value("7 mod 3"), 1);
  EXPECT_EQ(value("-7 mod 3"), 2);
  EXPECT_EQ(value("7 mod -3"), 1);
  EXPECT_EQ(value("-7 mod -3"), 2);
  EXPECT_FALSE(std::signbit(value("-6 mod 3")));
  EXPECT_EQ(value("5.5 mod 2"), 1.5);
}

TEST(Expressions, compare_equal_within_the_tolerance) {
  EXPECT_EQ(value("1 eq 1.0000009"), 1);
  EXPECT_EQ(value("1 eq 1.0000011"), 0);
  EXPECT_EQ(value("1 ne 1.0000009"), 0);
  EXPECT_EQ(value("1 ne 1.0000011"), 1);
  EXPECT_EQ(value("1 lt 1.0000001"), 1);
  EXPECT_EQ(value("2 ge 2"), 1);
  EXPECT_EQ(value("2 le 1"), 0);
  EXPECT_EQ(value("2 gt 2"), 0);
}

TEST(Expressions, combine_truth_as_zero_and_one) {
  EXPECT_EQ(value("5 and -3"), 1);
  EXPECT_EQ(value("5 and 0"), 0);
  EXPECT_EQ(value("0 or 0.1"), 1);
  EXPECT_EQ(value("0 or 0"), 0);
  EXPECT_EQ(value("3 xor 5"), 0);
  EXPECT_EQ(value("3 xor 0"), 1);
}

TEST(Functions, round_as_in_linuxcnc) {
  EXPECT_EQ(value("fix[2.8]"), 2);
  EXPECT_EQ(value("fix[-2.8]"), -3);
  EXPECT_EQ(value("fup[2.2]"), 3);
  EXPECT_EQ(value("fup[-2.8]"), -2);
  EXPECT_EQ(value("round[2.5]"), 3);
  EXPECT_EQ(value("round[-2.5]"), -3);
  EXPECT_EQ(value("round[3000000000.4]"), 3000000000.0);  // LinuxCNC overflows an int here
  EXPECT_EQ(value("abs[-2.5]"), 2.5);
}

TEST(Functions, take_degrees) {
  EXPECT_NEAR(value("sin[30]"), 0.5, 1e-15);
  EXPECT_NEAR(value("cos[60]"), 0.5, 1e-15);
  EXPECT_NEAR(value("tan[45]"), 1, 1e-15);
  EXPECT_NEAR(value("asin[1]"), 90, 1e-13);
  EXPECT_NEAR(value("acos[0]"), 90, 1e-13);
  EXPECT_NEAR(value("atan[1]/[1]"), 45, 1e-13);
  EXPECT_NEAR(value("atan[-1]/[-1]"), -135, 1e-13);
  EXPECT_EQ(value("atan[0]/[0]"), 0);
  EXPECT_NEAR(value("2*atan[1]/[1]/3"), 30, 1e-13);
}

TEST(Functions, know_powers_and_logarithms) {
  EXPECT_EQ(value("sqrt[9]"), 3);
  EXPECT_NEAR(value("ln[exp[2]]"), 2, 1e-15);
  EXPECT_EQ(value("-8**3"), -512);
  EXPECT_EQ(value("4**-0.5"), 0.5);
  EXPECT_EQ(value("0**0"), 1);
}

TEST(Parameters, are_read_by_number_and_through_one_another) {
  EXPECT_EQ(value("#1+#3"), 12.5);
  EXPECT_EQ(value("##2"), 10);
  EXPECT_EQ(value("#[1+1]"), 1);
  EXPECT_EQ(value("-#1**2"), 100);
  EXPECT_EQ(value("#1.00001"), 10);
  EXPECT_EQ(value("exists[#1]"), 1);
  EXPECT_EQ(value("exists[#99]"), 0);
  EXPECT_EQ(value("exists[##2]"), 1);
  EXPECT_EQ(value("exists[#<nothing>]"), 0);
}

TEST(Parameters, are_read_by_name) {
  ParsedLine line("X[#<A b>*2] Y[exists[#<ab>]]");
  ASSERT_TRUE(line.good);
  line.parameters.names[line.symbols.intern("ab").id] = 4;
  EXPECT_EQ(line.value(0), 8);
  EXPECT_EQ(line.value(1), 1);
}

TEST(Evaluation, points_at_what_cannot_be_computed) {
  EXPECT_EQ(failure("1+2/[3-3]", Kind::division_by_zero, 0), "2/[3-3]");
  EXPECT_EQ(failure("1 mod 0", Kind::division_by_zero, 0), "1 mod 0");
  EXPECT_EQ(failure("1+sqrt[-2]", Kind::domain, -2), "sqrt[-2]");
  EXPECT_EQ(failure("ln[0]", Kind::domain, 0), "ln[0]");
  EXPECT_EQ(failure("acos[1.5]", Kind::domain, 1.5), "acos[1.5]");
  EXPECT_EQ(failure("asin[-2]", Kind::domain, -2), "asin[-2]");
  EXPECT_EQ(failure("-2**0.5", Kind::domain, -2), "-2**0.5");
  EXPECT_EQ(failure("0**-1", Kind::division_by_zero, 0), "0**-1");
  EXPECT_EQ(failure("1+ #22 ", Kind::unknown_parameter, 22), "#22");
  EXPECT_EQ(failure("#<none>", Kind::unknown_parameter, 0), "#<none>");
  EXPECT_EQ(failure("#1.5", Kind::bad_parameter_number, 1.5), "#1.5");
  EXPECT_EQ(failure("#[#1/4]", Kind::bad_parameter_number, 2.5), "#[#1/4]");
  EXPECT_EQ(failure("exists[#1.5]", Kind::bad_parameter_number, 1.5), "exists[#1.5]");
  EXPECT_EQ(failure("#[10**300]", Kind::bad_parameter_number, 1e300), "#[10**300]");
  EXPECT_EQ(failure("exp[1000]", Kind::not_finite, std::numeric_limits<double>::infinity()), "exp[1000]");
  EXPECT_EQ(failure("10**200*10**200", Kind::not_finite, std::numeric_limits<double>::infinity()), "10**200*10**200");
}

TEST(Evaluation, takes_infinity_of_a_parameter_for_an_error) {
  ParsedLine line("X#1");
  line.parameters.numbers[1] = std::nan("");
  EXPECT_EQ(line.evaluation(line.block.words.at(0).value).error().kind, Kind::not_finite);
}

TEST(Expressions, are_bounded_in_depth) {
  const auto nested = [](std::size_t depth) {
    return ParsedLine("X" + std::string(depth, '[') + "1" + std::string(depth, ']'));
  };
  EXPECT_TRUE(nested(deepest_expression).good);
  EXPECT_EQ(nested(deepest_expression + 1).fault_at(), "gcode.expression-too-deep 66 1");
  EXPECT_EQ(ParsedLine("X" + std::string(deepest_expression, '[')).fault_at(), "gcode.missing-value 65 1");
  EXPECT_EQ(ParsedLine("X" + std::string(60'000, '[')).fault_at(), "gcode.expression-too-deep 66 1");
  EXPECT_EQ(ParsedLine("X" + std::string(60'000, '#')).fault_at(), "gcode.expression-too-deep 66 1");
  EXPECT_EQ(ParsedLine("X" + std::string(60'000, '-')).fault_at(), "gcode.expression-too-deep 66 1");
  std::string functions;
  for (int i = 0; i < 10'000; ++i) functions += "SIN[";
  EXPECT_EQ(ParsedLine("X" + functions).fault_at().substr(0, 25), "gcode.expression-too-deep");
}

TEST(Expressions, that_hold_too_many_numbers_at_once_are_refused_before_they_are_evaluated) {
  std::string text = "X";
  for (int i = 0; i < 30; ++i) text += "[1 OR 1 EQ 1 + 1 * 2 ** ";
  text += "1" + std::string(30, ']');
  EXPECT_EQ(ParsedLine(text).fault_at().substr(0, 25), "gcode.expression-too-deep");
}

TEST(Expressions, may_be_long_where_they_are_not_deep) {
  std::string text = "X[1";
  for (int i = 0; i < 5000; ++i) text += "+1";
  const ParsedLine line(text + "]");
  ASSERT_TRUE(line.good);
  EXPECT_EQ(line.value(), 5001);
}

// The oracle: a flat list of values and operators, worked off precedence by precedence from the left. Brackets are
// lists again.
class RandomExpression {
 public:
  explicit RandomExpression(std::uint64_t seed) : random_(seed) {}

  // Text without the outer brackets, and its value; NaN where the oracle gives up.
  std::pair<std::string, double> make(int depth) {
    std::vector<double> values;
    std::vector<std::string> operators;
    std::string text;
    const auto count = 1 + random_() % 5;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (i > 0) {
        operators.push_back(names[random_() % names.size()]);
        text += blank() + operators.back() + blank();
      }
      const auto [operand, number] = make_operand(depth);
      text += operand;
      values.push_back(number);
    }
    work_off(values, operators, {"**"});
    work_off(values, operators, {"*", "/", "MOD"});
    work_off(values, operators, {"+", "-"});
    work_off(values, operators, {"EQ", "NE", "GT", "GE", "LT", "LE"});
    work_off(values, operators, {"AND", "OR", "XOR"});
    return {text, values[0]};
  }

 private:
  std::pair<std::string, double> make_operand(int depth) {
    const auto choice = random_() % 8;
    if (depth > 0 && choice == 0) {
      const auto [text, number] = make(depth - 1);
      return {"[" + text + "]", number};
    }
    if (depth > 0 && choice == 1) {
      const auto [text, number] = make(depth - 1);
      return {"-abs[" + text + "]", -std::fabs(number)};
    }
    const auto number = static_cast<double>(random_() % 400) / 4;
    const std::string digits = std::to_string(number);
    return choice == 2 ? std::pair("- " + digits, -number) : std::pair(digits, number);
  }

  static void work_off(std::vector<double>& values, std::vector<std::string>& operators,
                       const std::vector<std::string>& tier) {
    for (std::size_t i = 0; i < operators.size();) {
      if (std::find(tier.begin(), tier.end(), operators[i]) == tier.end()) {
        ++i;
        continue;
      }
      values[i] = apply(operators[i], values[i], values[i + 1]);
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      operators.erase(operators.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  static double apply(const std::string& name, double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return std::nan("");
    if (name == "**") return a < 0 && b != std::floor(b) ? std::nan("") : std::pow(a, b);
    if (name == "*") return a * b;
    if (name == "/") return b == 0 ? std::nan("") : a / b;
    if (name == "MOD") {
      const double rest = std::fmod(a, b);
      return rest < 0 ? rest + std::fabs(b) : rest;
    }
    if (name == "+") return a + b;
    if (name == "-") return a - b;
    if (name == "EQ") return std::fabs(a - b) < 1e-6;
    if (name == "NE") return std::fabs(a - b) >= 1e-6;
    if (name == "GT") return a > b;
    if (name == "GE") return a > b || std::fabs(a - b) < 1e-6;
    if (name == "LT") return a < b;
    if (name == "LE") return a < b || std::fabs(a - b) < 1e-6;
    if (name == "AND") return a != 0 && b != 0;
    if (name == "OR") return a != 0 || b != 0;
    return (a != 0) != (b != 0);
  }

  std::string blank() { return random_() % 2 == 0 ? " " : ""; }

  const std::vector<std::string> names = {"**", "*",  "/",  "MOD", "+",   "-",  "EQ", "NE",
                                          "GT", "GE", "LT", "LE",  "AND", "OR", "XOR"};
  std::mt19937_64 random_;
};

TEST(Expressions, have_the_value_of_an_oracle_that_works_off_operators_tier_by_tier) {
  RandomExpression random(test::seed());
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto [text, expected] = random.make(3);
    const ParsedLine line("X[" + text + "]");
    ASSERT_TRUE(line.good) << text << render(line.diagnostics, false);
    const Evaluation result = line.evaluation(line.block.words[0].value);
    if (!std::isfinite(expected)) continue;
    ASSERT_TRUE(result) << text << " = " << expected;
    ASSERT_EQ(*result, expected) << text;
    ++compared;
  }
  EXPECT_GT(compared, 10'000);
}

}  // namespace
}  // namespace passo
