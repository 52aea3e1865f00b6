#include "number.hpp"

#include <array>
#include <charconv>
#include <cstddef>

#include "characters.hpp"

#include "passo/base/read_double.hpp"

namespace passo {
namespace {

constexpr std::array<double, 23> powers_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                  1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t largest_exact_integer = std::uint64_t{1} << 53;
constexpr std::size_t most_digits_of_mantissa = 18;  // fits std::uint64_t, whatever the digits

// Reads what the fast path cannot round correctly: read_double() on a copy without blanks.
NumberReading read_long_number(const char* first, const char* last, bool negative) {
  std::array<char, longest_number> digits;
  std::size_t size = 0;
  bool before_point = true;
  bool has_integer_part = false;
  NumberReading reading{0, last, NumberStatus::good};
  for (const char* at = first; at != last; ++at) {
    if (!is_digit(*at) && *at != '.') continue;
    before_point = before_point && *at != '.';
    has_integer_part = has_integer_part || (before_point && *at != '0');
    if (size == 0 && *at == '0') continue;  // leading zeros do not count as digits
    if (size == digits.size()) {
      reading.status = NumberStatus::too_long;
      return reading;
    }
    digits[size++] = *at;
  }
  const auto result = read_double(digits.data(), digits.data() + size, reading.value);
  if (result.ec == std::errc::result_out_of_range) {
    reading.value = 0;  // too small becomes zero; too large is an error
    if (has_integer_part) reading.status = NumberStatus::too_large;
  }
  if (negative) reading.value = -reading.value;
  return reading;
}

// The digits of a number, and how many of them there are.
struct Digits {
  std::uint64_t mantissa = 0;  // not used after most_digits_of_mantissa
  std::size_t count = 0;
  std::size_t decimals = 0;
  const char* end = nullptr;  // after the last digit or the decimal point
  bool spaced = false;
};

// Digits with blanks between them.
Digits read_spaced_digits(const char* at, const char* end) {
  Digits digits{.end = at};
  bool point = false;
  bool after_blank = false;  // a blank has come since the last digit or point
  for (; at != end; ++at) {
    if ((is_digit(*at) || (*at == '.' && !point)) && after_blank) digits.spaced = true;
    if (is_digit(*at)) {
      digits.mantissa = digits.mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
      ++digits.count;
      digits.decimals += point ? 1 : 0;
    } else if (*at == '.' && !point) {
      point = true;
    } else if (is_blank(*at)) {
      after_blank = digits.count > 0 || point;
      continue;
    } else {
      break;
    }
    digits.end = at + 1;
  }
  return digits;
}

// Nearly every number is written without blanks, and is read without looking for them.
Digits read_digits(const char* const first, const char* end) {
  const char* at = first;
  std::uint64_t mantissa = 0;
  for (; at != end && is_digit(*at); ++at) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
  auto count = static_cast<std::size_t>(at - first);
  std::size_t decimals = 0;
  if (at != end && *at == '.') {
    const char* const point = at++;
    for (; at != end && is_digit(*at); ++at) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
    decimals = static_cast<std::size_t>(at - point) - 1;
    count += decimals;
  }
  const char* next = at;
  while (next != end && is_blank(*next)) ++next;
  const bool goes_on = next != at && next != end && (is_digit(*next) || *next == '.');
  return goes_on ? read_spaced_digits(first, end) : Digits{mantissa, count, decimals, at};
}

}  // namespace

NumberReading read_number(const char* at, const char* end) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;

  const Digits digits = read_digits(at, end);
  if (digits.count == 0) return {0, digits.end, NumberStatus::no_digits};
  // Both operands are exact doubles, so the one division rounds correctly.
  if (digits.count <= most_digits_of_mantissa && digits.mantissa <= largest_exact_integer &&
      digits.decimals < powers_of_ten.size()) {
    const double value = static_cast<double>(digits.mantissa) / powers_of_ten[digits.decimals];
    return {negative ? -value : value, digits.end, NumberStatus::good, digits.spaced};
  }
  NumberReading reading = read_long_number(at, digits.end, negative);
  reading.spaced = digits.spaced;
  return reading;
}

std::string format_number(double value) {
  std::array<char, longest_number> text;
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return {text.data(), result.ptr};
}

}  // namespace passo
