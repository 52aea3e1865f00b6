// read_double(): std::from_chars() for a double, also with a standard library that has it for integers only (libc++ 16,
// with which the page's modules are compiled). Nothing depends on a locale.
#pragma once

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <system_error>

namespace passo {

#ifdef __cpp_lib_to_chars
inline std::from_chars_result read_double(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}
#else
// Digits, a point and an exponent. Names such as "inf" are no numbers here; callers refuse them in any case.
inline std::from_chars_result read_double(const char* first, const char* last, double& value) {
  std::array<char, 1200> copy;  // a number of G-code has at most 1,100 digits
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const char* at = first;
  bool digits = false;
  const auto take_digits = [&] {
    for (; at != last && is_digit(*at); ++at) digits = true;
  };
  if (at != last && *at == '-') ++at;
  take_digits();
  if (at != last && *at == '.') {
    ++at;
    take_digits();
  }
  if (!digits) return {first, std::errc::invalid_argument};
  if (at != last && (*at == 'e' || *at == 'E')) {
    const char* exponent = at + 1;
    if (exponent != last && (*exponent == '-' || *exponent == '+')) ++exponent;
    if (exponent != last && is_digit(*exponent)) {
      at = exponent;
      take_digits();
    }
  }
  const auto size = static_cast<std::size_t>(at - first);
  if (size >= copy.size()) return {at, std::errc::result_out_of_range};
  for (std::size_t i = 0; i < size; ++i) copy[i] = first[i];
  copy[size] = '\0';
  errno = 0;
  const double read = std::strtod(copy.data(), nullptr);
  if (errno == ERANGE && (std::isinf(read) || read == 0)) return {at, std::errc::result_out_of_range};
  value = read;
  return {at, std::errc()};
}
#endif

}  // namespace passo
