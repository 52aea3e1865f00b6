#include "characters.hpp"

#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "passo/base/utf8.hpp"

namespace passo {
namespace {

// Characters that word processors, web pages and foreign keyboards produce in place of those of RS274/NGC.
struct LookAlike {
  std::uint32_t code;
  const char* meant;
};

constexpr const char* keyboard_minus = "'-' (the minus sign on the keyboard)";
constexpr const char* space = "a plain space";
constexpr const char* nothing = "nothing: this character is invisible";

constexpr std::array look_alikes = {
    LookAlike{0x00A0, space},
    LookAlike{0x00AD, nothing},
    LookAlike{0x00B0, "no unit; angles are in degrees"},
    LookAlike{0x00B7, "'*'"},
    LookAlike{0x00D7, "'*'"},
    LookAlike{0x00F7, "'/'"},
    LookAlike{0x0410, "'A'"},
    LookAlike{0x0412, "'B'"},
    LookAlike{0x0415, "'E'"},
    LookAlike{0x0417, "'3'"},
    LookAlike{0x041A, "'K'"},
    LookAlike{0x041C, "'M'"},
    LookAlike{0x041D, "'H'"},
    LookAlike{0x041E, "'0'"},
    LookAlike{0x0420, "'P'"},
    LookAlike{0x0421, "'C'"},
    LookAlike{0x0422, "'T'"},
    LookAlike{0x0423, "'Y'"},
    LookAlike{0x0425, "'X'"},
    LookAlike{0x0430, "'A'"},
    LookAlike{0x0435, "'E'"},
    LookAlike{0x043E, "'0'"},
    LookAlike{0x0440, "'P'"},
    LookAlike{0x0441, "'C'"},
    LookAlike{0x0443, "'Y'"},
    LookAlike{0x0445, "'X'"},
    LookAlike{0x2009, space},
    LookAlike{0x200B, nothing},
    LookAlike{0x2010, keyboard_minus},
    LookAlike{0x2011, keyboard_minus},
    LookAlike{0x2012, keyboard_minus},
    LookAlike{0x2013, keyboard_minus},
    LookAlike{0x2014, keyboard_minus},
    LookAlike{0x2015, keyboard_minus},
    LookAlike{0x202F, space},
    LookAlike{0x2212, keyboard_minus},
    LookAlike{0x2215, "'/'"},
    LookAlike{0x2217, "'*'"},
    LookAlike{0x22C5, "'*'"},
    LookAlike{0x3000, space},
    LookAlike{0xFEFF, nothing},
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
  const CodePoint point = first_code_point(text);
  if (point.length == 0) {
    return {1, fmt::format("byte 0x{:02X}, which is not UTF-8,", static_cast<unsigned char>(text[0])), {}};
  }
  const auto code = static_cast<std::uint32_t>(point.value);
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) {
    return {point.length, fmt::format("control character U+{:04X}", code), {}};
  }
  if (point.length == 1) return {1, fmt::format("'{}'", text[0]), {}};
  return {point.length, fmt::format("U+{:04X} '{}'", code, text.substr(0, point.length)), cure_for(code)};
}

}  // namespace passo
