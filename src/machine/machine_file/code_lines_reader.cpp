#include "code_lines_reader.hpp"

#include <variant>

#include <fmt/format.h>

namespace passo {

std::string read_code_lines(TableReader& reader, const char* code, std::string_view key, const TomlValue& value) {
  constexpr std::size_t most_lines = 200;
  constexpr std::size_t longest = 255;
  const auto* const lines = std::get_if<TomlArray>(&value.content);
  if (lines == nullptr || lines->empty() || lines->size() > most_lines) {
    reader.error(code, key, fmt::format("{} is not a list of 1 to {} lines", reader.full_name(key), most_lines),
                 fmt::format("a list of lines of G-code, e.g. {} = [\"G53 G0 X0 Y0\", \"G53 G1 Z-50 F500\"]", key));
    return {};
  }
  std::string text;
  for (const TomlValue& one : *lines) {
    const auto* const line = std::get_if<std::string>(&one.content);
    const bool good = line != nullptr && line->size() <= longest && line->find_first_of("\r\n") == std::string::npos;
    if (!good) {
      reader.error(code, key, fmt::format("{} has {} in its list", reader.full_name(key), kind_of(one)),
                   fmt::format("lines of at most {} characters", longest));
      return {};
    }
    text += *line + "\n";
  }
  return text;
}

}  // namespace passo
