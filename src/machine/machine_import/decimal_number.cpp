#include "decimal_number.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::int64_t most_digits = 1'000'000'000'000'000'000;  // below this, ten times as much overflows
constexpr int most_exponent = 300;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The place after the digits that begin at `at`.
std::size_t after_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

// The length of a number at the start of the text; 0: there is none.
std::size_t number_length(std::string_view text) {
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t whole = at;
  at = after_digits(text, at);
  std::size_t digits = at - whole;
  if (at < text.size() && text[at] == '.') {
    const std::size_t after = after_digits(text, at + 1);
    digits += after - at - 1;
    at = after;
  }
  if (digits == 0) return 0;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+') ? 1 : 0;
    const std::size_t after = after_digits(text, at + 1 + sign);
    if (after > at + 1 + sign) at = after;
  }
  return at;
}

}  // namespace

DecimalNumber DecimalNumber::exact(std::int64_t digits, int exponent) {
  while (digits != 0 && digits % 10 == 0) {
    digits /= 10;
    ++exponent;
  }
  DecimalNumber result(digits);
  result.exponent_ = digits == 0 ? 0 : exponent;
  // The nearest double, as TOML's reader makes it of the same text.
  result.value_ = std::strtod(fmt::format("{}e{}", digits, result.exponent_).c_str(), nullptr);
  return result;
}

DecimalNumber DecimalNumber::of(double value) {
  DecimalNumber result;
  result.value_ = value;
  result.is_exact_ = false;
  return result;
}

std::optional<DecimalNumber> DecimalNumber::parse(std::string_view text) {
  if (text.empty() || text.size() > 100 || number_length(text) != text.size()) return std::nullopt;
  const double value = std::strtod(std::string(text).c_str(), nullptr);
  if (!std::isfinite(value)) return std::nullopt;
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const long power = e == text.size() ? 0 : std::strtol(std::string(text.substr(e + 1)).c_str(), nullptr, 10);
  if (power < -most_exponent || power > most_exponent) return of(value);
  std::int64_t digits = 0;
  int exponent = static_cast<int>(power);
  bool after_point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') after_point = true;
    if (!is_digit(c)) continue;
    if (digits >= most_digits / 10) return of(value);
    digits = digits * 10 + (c - '0');
    if (after_point) --exponent;
  }
  return exact(text.front() == '-' ? -digits : digits, exponent);
}

std::string DecimalNumber::text() const {
  if (!is_exact_ || exponent_ > 15 || exponent_ < -25) return fmt::format("{}", value_);
  const std::string digits = fmt::format("{}", digits_ < 0 ? -digits_ : digits_);
  const char* const sign = digits_ < 0 ? "-" : "";
  if (exponent_ >= 0) return sign + digits + std::string(static_cast<std::size_t>(exponent_), '0');
  const auto places = static_cast<std::size_t>(-exponent_);
  const std::string padded = digits.size() > places ? digits : std::string(places + 1 - digits.size(), '0') + digits;
  return sign + padded.substr(0, padded.size() - places) + "." + padded.substr(padded.size() - places);
}

DecimalNumber DecimalNumber::operator-() const {
  DecimalNumber result = *this;
  result.value_ = value_ == 0 ? 0 : -value_;
  result.digits_ = -digits_;
  return result;
}

DecimalNumber DecimalNumber::scaled(std::int64_t factor, std::int64_t divisor) const {
  const DecimalNumber rounded = of(value_ * static_cast<double>(factor) / static_cast<double>(divisor));
  if (!is_exact_) return rounded;
  const auto fits = [](std::int64_t digits, std::int64_t by) { return (digits < 0 ? -digits : digits) < most_digits / by; };
  if (!fits(digits_, factor)) return rounded;
  std::int64_t digits = digits_ * factor;
  // A divisor below 10^5 has at most 16 factors 2, so more zeros cannot help.
  for (int zeros = 0; zeros <= 16; ++zeros) {
    if (digits % divisor == 0) return exact(digits / divisor, exponent_ - zeros);
    if (!fits(digits, 10)) return rounded;
    digits *= 10;
  }
  return rounded;
}

DecimalNumber operator+(const DecimalNumber& a, const DecimalNumber& b) {
  const DecimalNumber rounded = DecimalNumber::of(a.value_ + b.value_);
  if (!a.is_exact_ || !b.is_exact_) return rounded;
  DecimalNumber high = a.exponent_ >= b.exponent_ ? a : b;
  const DecimalNumber& low = a.exponent_ >= b.exponent_ ? b : a;
  if (low.digits_ == 0) return high;
  while (high.exponent_ > low.exponent_) {
    if (high.digits_ >= most_digits / 10 || high.digits_ <= -most_digits / 10) return rounded;
    high.digits_ *= 10;
    --high.exponent_;
  }
  return DecimalNumber::exact(high.digits_ + low.digits_, low.exponent_);
}

}  // namespace passo
