// DecimalNumber: a number of a configuration file, as exact as it is written there.
//
// 500 mm/min is 8.333333333333334 mm/s, but 0.1 in is 2.54 mm and not 2.5400000000000005: products and quotients are
// exact where the result is a decimal of at most 18 digits, and rounded to a double otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace passo {

class DecimalNumber {
 public:
  DecimalNumber() = default;
  explicit DecimalNumber(std::int64_t whole) : value_(static_cast<double>(whole)), digits_(whole) {}

  // "1600", "-0.5", "675.", "4.8e+004". Nothing: not such a number, or not finite.
  static std::optional<DecimalNumber> parse(std::string_view text);
  // The double nearest to `value`, which is finite.
  static DecimalNumber of(double value);

  double value() const { return value_; }
  // The shortest text that TOML reads as this number.
  std::string text() const;

  DecimalNumber operator-() const;
  DecimalNumber magnitude() const { return value_ < 0 ? -*this : *this; }
  // `factor` and `divisor` are from 1 to 100,000.
  DecimalNumber scaled(std::int64_t factor, std::int64_t divisor) const;
  friend DecimalNumber operator+(const DecimalNumber& a, const DecimalNumber& b);
  friend DecimalNumber operator-(const DecimalNumber& a, const DecimalNumber& b) { return a + -b; }
  friend bool operator<(const DecimalNumber& a, const DecimalNumber& b) { return a.value_ < b.value_; }

 private:
  static DecimalNumber exact(std::int64_t digits, int exponent);

  double value_ = 0;
  // value_ = digits_ × 10^exponent_, if is_exact_.
  std::int64_t digits_ = 0;
  int exponent_ = 0;
  bool is_exact_ = true;
};

}  // namespace passo
