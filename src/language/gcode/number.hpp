// Decimal numbers of RS274/NGC: a sign, digits and a decimal point, with blanks anywhere and without an exponent.
#pragma once

#include <cstdint>
#include <string>

namespace passo {

enum class NumberStatus : std::uint8_t {
  good,
  no_digits,
  too_large,  // the number is not a finite double
  too_long,   // more than `longest_number` digits
};

// Sufficient for every double written out in full.
inline constexpr std::size_t longest_number = 1100;

struct NumberReading {
  double value = 0;
  const char* end = nullptr;  // after the last digit or the decimal point
  NumberStatus status = NumberStatus::good;
  bool spaced = false;  // whether there are blanks between its digits
};

// Reads the longest number that starts at `at`, correctly rounded. Takes a few nanoseconds for up to 15 digits.
NumberReading read_number(const char* at, const char* end);

// Returns the shortest text without an exponent that is read back as the same double.
std::string format_number(double value);

}  // namespace passo
