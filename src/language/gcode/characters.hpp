// Classifies the characters of a line in RS274/NGC, and names invalid characters.
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
// Expects an upper-case character.
constexpr bool is_letter(char c) {
  return c >= 'A' && c <= 'Z';
}

// An invalid character as shown in messages, and its replacement.
struct NamedCharacter {
  std::size_t length = 1;  // bytes
  std::string name;        // "'='", "U+00B0 '°'", "control character U+0007", "byte 0xE9"
  std::string cure;        // "'-' (minus)"; empty: no suggestion
};

// Names the first character of `text`, which must not be empty.
NamedCharacter name_character(std::string_view text);

}  // namespace passo
