// Names that people give: of programs and drawings in a query, and of clients.
#include <algorithm>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t longest_name = 200;  // bytes: with what is added to it, a file's name has at most 255
constexpr char32_t no_character = 0xFFFFFFFF;

// The character of UTF-8 at the start of a text, and its bytes. `no_character`: there is none.
struct FirstCharacter {
  char32_t value = no_character;
  std::size_t bytes = 1;
};

FirstCharacter first_of(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {.value = lead};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  char32_t value = lead & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0U) != 0x80) return {};
    value = value << 6U | (byte & 0x3FU);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (value < least[bytes] || value > 0x10FFFF || is_surrogate) return {};
  return {.value = value, .bytes = bytes};
}

// Characters that do something to a line instead of standing in it: controls, line ends, and what turns the direction
// of text, so that "cgn.exe" looks like "exe.ngc".
bool is_control(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

// Why it is no name. Empty: it is one.
std::string_view fault_of(std::string_view name) {
  if (name.size() > longest_name) return "it is longer than 200 bytes";
  if (name.front() == '.') return "it begins with a dot";
  if (name.find('/') != std::string_view::npos || name.find('\\') != std::string_view::npos) {
    return "it has a / or a \\";
  }
  while (!name.empty()) {
    const FirstCharacter first = first_of(name);
    if (first.value == no_character) return "it is not UTF-8";
    if (is_control(first.value)) return "it has control characters";
    name.remove_prefix(first.bytes);
  }
  return {};
}

}  // namespace

Result<std::string, WebAnswer> name_from(std::string_view query, std::string_view otherwise) {
  const std::string_view written = query_value(query, "name");
  if (written.empty()) return std::string(otherwise);
  const auto refused = [](std::string_view why) {
    return Failure{error_answer(400, "http.bad-name", fmt::format("this name cannot be kept: {}", why))};
  };
  auto name = percent_decoded(written);
  if (!name) return refused("a % in it is not followed by two hexadecimal digits; %25 stands for %");
  if (const std::string_view fault = fault_of(*name); !fault.empty()) return refused(fault);
  return std::move(*name);
}

std::string words_from(std::string_view text, std::string_view otherwise) {
  std::string words;
  while (!text.empty()) {
    const FirstCharacter first = first_of(text);
    if (words.size() + first.bytes > longest_name) break;
    if (first.value != no_character && !is_control(first.value)) words += text.substr(0, first.bytes);
    text.remove_prefix(first.bytes);
  }
  return words.empty() ? std::string(otherwise) : words;
}

}  // namespace passo
