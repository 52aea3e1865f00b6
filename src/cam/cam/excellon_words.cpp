#include "excellon_words.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {

std::optional<DrillWordFault> scan_drill_words(std::string_view text, std::uint32_t first_column,
                                               std::vector<DrillWord>& words) {
  words.clear();
  std::uint32_t column = first_column;
  while (!text.empty()) {
    const char letter = text.front();
    if (letter == ';') break;
    std::size_t size = 1;
    if (letter != ' ' && letter != '\t') {
      if (letter < 'A' || letter > 'Z') {
        return DrillWordFault{column, "this is not a drill command", "a letter and a number, e.g. X1.27"};
      }
      size = std::min(text.find_first_not_of("+-.0123456789", 1), text.size());
      if (size == 1) {
        return DrillWordFault{column, fmt::format("'{}' has no number", letter),
                              "a drill command, e.g. X1.27Y2.54, T1 or M30"};
      }
      words.push_back({letter, text.substr(1, size - 1), column});
    }
    text.remove_prefix(size);
    column += static_cast<std::uint32_t>(size);
  }
  return std::nullopt;
}

}  // namespace passo
