// counted: a number and its noun, as messages and programs say it: "1 hole", "2 holes", "1 234 holes", "2 entries".
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

// 1234567 as "1 234 567".
inline std::string grouped(std::int64_t number) {
  std::string digits = std::to_string(number);
  const std::size_t first = number < 0 ? 1 : 0;
  for (std::size_t end = digits.size(); end > first + 3; end -= 3) digits.insert(end - 3, 1, ' ');
  return digits;
}
inline std::string grouped(std::uint64_t number) {
  return grouped(static_cast<std::int64_t>(number));
}

// The end of a noun, where its number is written in another way.
inline std::string_view plural_end(bool is_one) {
  return is_one ? "" : "s";
}

// With a minus before what is below zero, as of a place in steps.
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
