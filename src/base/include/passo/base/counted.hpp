// counted: a number and its noun, as messages and programs say it: "1 hole", "2 holes", "1 234 holes".
#pragma once

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

inline std::string counted(std::uint64_t number, std::string_view noun) {
  return grouped(number).append(" ").append(noun).append(number == 1 ? "" : "s");
}

}  // namespace passo
