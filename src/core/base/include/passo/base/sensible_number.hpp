// sensible_number: formats a number for people: "285.46", "1234567", "0.00123". It has six significant digits, but
// never fewer than those before the decimal point, and no exponent from 0.0001 to 1e15. Files for programs (CSV, JSON)
// contain all digits instead.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace passo {

inline std::string sensible_number(double value, int digits = 6) {
  const double size = std::abs(value);
  const bool is_long = size >= std::pow(10.0, digits) - 0.5 && size < 1e15;
  std::array<char, 32> text{};
  const auto written =
      is_long ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 0)
              : std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return {text.data(), written.ptr};
}

}  // namespace passo
