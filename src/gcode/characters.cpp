#include "characters.hpp"

#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace passo {
namespace {

// A code point of UTF-8. Length 0 means that the bytes are not UTF-8.
struct CodePoint {
  std::uint32_t value = 0;
  std::size_t length = 0;
};

CodePoint decode(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return {};
  std::uint32_t value = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    value = (value << 6U) | (byte(i) & 0x3FU);
  }
  const bool is_overlong = (length == 3 && value < 0x800) || (length == 4 && value < 0x10000);
  const bool is_surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (is_overlong || is_surrogate || value > 0x10FFFF) return {};
  return {value, length};
}

// Characters that word processors, web pages and foreign keyboards produce in place of those of RS274/NGC.
struct LookAlike {
  std::uint32_t code;
  const char* meant;
};

constexpr const char* minus = "'-' (minus sign of the keyboard)";
constexpr const char* space = "a plain space";
constexpr const char* nothing = "nothing: this character is invisible";

constexpr std::array look_alikes = {
    LookAlike{0x00A0, space},   LookAlike{0x00AD, nothing}, LookAlike{0x00B0, "no unit: angles are in degrees"},
    LookAlike{0x00B7, "'*'"},   LookAlike{0x00D7, "'*'"},   LookAlike{0x00F7, "'/'"},
    LookAlike{0x0410, "'A'"},   LookAlike{0x0412, "'B'"},   LookAlike{0x0415, "'E'"},
    LookAlike{0x0417, "'3'"},   LookAlike{0x041A, "'K'"},   LookAlike{0x041C, "'M'"},
    LookAlike{0x041D, "'H'"},   LookAlike{0x041E, "'0'"},   LookAlike{0x0420, "'P'"},
    LookAlike{0x0421, "'C'"},   LookAlike{0x0422, "'T'"},   LookAlike{0x0423, "'Y'"},
    LookAlike{0x0425, "'X'"},   LookAlike{0x0430, "'A'"},   LookAlike{0x0435, "'E'"},
    LookAlike{0x043E, "'0'"},   LookAlike{0x0440, "'P'"},   LookAlike{0x0441, "'C'"},
    LookAlike{0x0443, "'Y'"},   LookAlike{0x0445, "'X'"},   LookAlike{0x2009, space},
    LookAlike{0x200B, nothing}, LookAlike{0x2010, minus},   LookAlike{0x2011, minus},
    LookAlike{0x2012, minus},   LookAlike{0x2013, minus},   LookAlike{0x2014, minus},
    LookAlike{0x2015, minus},   LookAlike{0x202F, space},   LookAlike{0x2212, minus},
    LookAlike{0x2215, "'/'"},   LookAlike{0x2217, "'*'"},   LookAlike{0x22C5, "'*'"},
    LookAlike{0x3000, space},   LookAlike{0xFEFF, nothing},
};

std::string cure_for(std::uint32_t code) {
  for (const LookAlike& look_alike : look_alikes) {
    if (look_alike.code == code) return look_alike.meant;
  }
  // The full-width copies of ASCII.
  if (code >= 0xFF01 && code <= 0xFF5E) return fmt::format("'{}'", static_cast<char>(code - 0xFF01 + '!'));
  return {};
}

}  // namespace

NamedCharacter name_character(std::string_view text) {
  const CodePoint point = decode(text);
  if (point.length == 0) {
    return {1, fmt::format("byte 0x{:02X}, which is not UTF-8,", static_cast<unsigned char>(text[0])), {}};
  }
  if (point.value < 0x20 || (point.value >= 0x7F && point.value < 0xA0)) {
    return {point.length, fmt::format("control character U+{:04X}", point.value), {}};
  }
  if (point.length == 1) return {1, fmt::format("'{}'", text[0]), {}};
  return {point.length, fmt::format("U+{:04X} '{}'", point.value, text.substr(0, point.length)), cure_for(point.value)};
}

}  // namespace passo
