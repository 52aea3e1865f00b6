// counted: formats a number with its noun, for messages and programs: "1 hole", "2 holes", "1 234 holes", "2 entries".
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

// Formats 1234567 as "1 234 567".
inline std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  const std::size_t first = number < 0 ? 1 : 0;
  for (std::size_t end = digits.size(); end > first + 3; end -= 3) digits.insert(end - 3, 1, ' ');
  return digits;
}
inline std::string grouped(std::uint64_t number) {
  return grouped(static_cast<std::int64_t>(number));
}

// Returns the plural ending of a noun, for callers that format the number themselves.
inline std::string_view plural_end(bool is_one) {
  return is_one ? "" : "s";
}

// Negative numbers, e.g. positions in steps, get a minus sign.
template <std::integral Number>
std::string counted(Number number, std::string_view noun, std::string_view nouns) {
  const auto wide = static_cast<std::int64_t>(number);
  return grouped(wide).append(" ").append(wide == 1 || wide == -1 ? noun : nouns);
}
template <std::integral Number>
std::string counted(Number number, std::string_view noun) {
  return counted(number, noun, std::string(noun) + "s");
}

}  // namespace passo
