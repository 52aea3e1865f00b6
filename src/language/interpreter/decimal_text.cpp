#include "decimal_text.hpp"

#include <array>
#include <cmath>

#include <fmt/compile.h>
#include <fmt/format.h>

namespace passo {
namespace {

// "00" to "99", so that digits are written in pairs.
constexpr auto pairs = [] {
  std::array<char, 200> digits{};
  for (std::size_t i = 0; i < 100; ++i) {
    digits[2 * i] = static_cast<char>('0' + i / 10);
    digits[2 * i + 1] = static_cast<char>('0' + i % 10);
  }
  return digits;
}();

void write_pair(char* to, std::uint64_t below_hundred) {
  const auto at = static_cast<std::size_t>(2 * below_hundred);
  to[0] = pairs[at];
  to[1] = pairs[at + 1];
}

constexpr std::uint64_t power_of_ten(int exponent) {
  return exponent == 0 ? 1 : 10 * power_of_ten(exponent - 1);
}

// The product `value * 10^decimals` is rounded once. Its nearest whole number is that of the exact product, because the
// product's error is smaller than its distance from the next half. A product that is a half itself may be on either
// side of it. Then the error decides, which a fused multiplication gives exactly.
template <int decimals>
char* write_decimal(char* to, double value) {
  static_assert(decimals % 2 == 0);
  constexpr double largest = 1e15;
  constexpr std::uint64_t unit = power_of_ten(decimals);
  const double scaled = std::abs(value) * static_cast<double>(unit);
  if (!(scaled < largest)) return fmt::format_to(to, FMT_COMPILE("{:.{}f}"), value, decimals);
  auto digits = static_cast<std::uint64_t>(static_cast<std::int64_t>(scaled));
  const double rest = scaled - static_cast<double>(static_cast<std::int64_t>(digits));
  const double error = rest == 0.5 ? std::fma(std::abs(value), static_cast<double>(unit), -scaled) : 0;
  if (rest > 0.5 || (rest == 0.5 && (error > 0 || (error == 0 && digits % 2 == 1)))) ++digits;
  if (std::signbit(value)) *to++ = '-';
  to = write_whole(to, digits / unit);
  *to++ = '.';
  std::uint64_t fraction = digits % unit;
  for (int i = decimals - 2; i >= 0; i -= 2) {
    write_pair(to + i, fraction % 100);
    fraction /= 100;
  }
  return to + decimals;
}

}  // namespace

char* write_decimal_4(char* to, double value) {
  return write_decimal<4>(to, value);
}

char* write_decimal_6(char* to, double value) {
  return write_decimal<6>(to, value);
}

char* write_whole(char* to, std::uint64_t value) {
  if (value < 10) return *to = static_cast<char>('0' + value), to + 1;
  if (value < 100) return write_pair(to, value), to + 2;
  std::array<char, 20> digits;  // of the largest value
  std::size_t at = digits.size();
  for (; value >= 100; value /= 100) write_pair(digits.data() + (at -= 2), value % 100);
  if (value >= 10) {
    write_pair(digits.data() + (at -= 2), value);
  } else {
    digits[--at] = static_cast<char>('0' + value);
  }
  for (; at < digits.size(); ++at) *to++ = digits[at];
  return to;
}

}  // namespace passo
