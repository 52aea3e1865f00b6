// What the characters of a line mean to RS274/NGC, and names for those without a meaning.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace passo {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr char to_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
// For an upper-case character.
constexpr bool is_letter(char c) {
  return c >= 'A' && c <= 'Z';
}

// A character as messages show it, and its replacement.
struct NamedCharacter {
  std::size_t length = 1;  // bytes
  std::string name;        // "'='", "U+00B0 '°'", "control character U+0007", "byte 0xE9"
  std::string cure;        // "'-' (minus)"; empty: unknown
};

// Names the first character of `text`, which must not be empty.
NamedCharacter name_character(std::string_view text);

}  // namespace passo
