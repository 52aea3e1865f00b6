#include "gerber_numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace passo {
namespace {

constexpr std::size_t most_decimals = 9;

bool is_decimal_digit(char c) {
  return c >= '0' && c <= '9';
}

// One digit each before and after the decimal point: "X24".
bool read_places(std::string_view& words, char axis, std::size_t& whole, std::size_t& decimals) {
  if (words.size() < 3 || words[0] != axis || !is_decimal_digit(words[1]) || !is_decimal_digit(words[2])) return false;
  whole = static_cast<std::size_t>(words[1] - '0');
  decimals = static_cast<std::size_t>(words[2] - '0');
  words.remove_prefix(3);
  return whole + decimals > 0;
}

std::optional<Nanometres> within_reach(long double nm) {
  const auto farthest = static_cast<long double>(farthest_drawn.count);
  if (!(nm >= -farthest && nm <= farthest)) return std::nullopt;
  return Nanometres{std::llround(nm)};
}

}  // namespace

std::optional<GerberFormat> read_gerber_format(std::string_view words) {
  GerberFormat format;
  while (!words.empty() && words.front() != 'X') {
    const char letter = words.front();
    words.remove_prefix(1);
    switch (letter) {
      case 'L':
      case 'D': format.left_out = LeftOutZeros::leading; break;
      case 'T': format.left_out = LeftOutZeros::trailing; break;
      case 'A':
      case 'I': format.is_incremental = letter == 'I'; break;
      case 'N':  // how many digits sequence numbers and codes have says nothing about places
      case 'G':
      case 'M':
        while (!words.empty() && is_decimal_digit(words.front())) words.remove_prefix(1);
        break;
      case ' ': break;
      default: return std::nullopt;
    }
  }
  if (!read_places(words, 'X', format.whole_x, format.decimals_x)) return std::nullopt;
  if (!read_places(words, 'Y', format.whole_y, format.decimals_y)) return std::nullopt;
  return format;
}

std::optional<double> read_gerber_decimal(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' '; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::string_view unsigned_text = text.substr(text.starts_with('-') ? 1 : 0);
  const auto is_good = [](char c) { return is_decimal_digit(c) || c == '.'; };
  if (unsigned_text.empty() || !std::ranges::all_of(unsigned_text, is_good)) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Nanometres> GerberNumbers::length(std::string_view text) const {
  const std::optional<double> value = read_gerber_decimal(text);
  if (!value) return std::nullopt;
  return within_reach(static_cast<long double>(*value) * static_cast<long double>(nm_per_unit()));
}

std::optional<Nanometres> GerberNumbers::coordinate(std::string_view text, std::size_t whole,
                                                    std::size_t decimals) const {
  if (text.find('.') != std::string_view::npos) return length(text);
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty() || !std::ranges::all_of(text, is_decimal_digit)) return std::nullopt;
  // Zeros in front say nothing, unless those behind are left out: then the places count from the front.
  std::size_t missing = 0;
  if (format.left_out == LeftOutZeros::trailing && text.size() < whole + decimals) {
    missing = whole + decimals - text.size();
  }
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
  if (text.size() > 18) return std::nullopt;
  // 18 digits, 2 powers of ten and 25.4 million are all exact in the 64 bits of a long double's mantissa, or nearly so.
  long double value = 0;
  for (const char digit : text) value = value * 10 + static_cast<long double>(digit - '0');
  for (std::size_t i = 0; i < missing; ++i) value *= 10;
  value *= static_cast<long double>(nm_per_unit());
  long double divisor = 1;
  for (std::size_t i = 0; i < std::min(decimals, most_decimals); ++i) divisor *= 10;
  return within_reach((is_negative ? -value : value) / divisor);
}

}  // namespace passo
