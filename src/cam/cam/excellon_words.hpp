// scan_drill_words: splits a line of a drill file into its words, e.g. "X1.27", "T1" or "M30". Private to cam/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

// A letter, and the text of its number.
struct DrillWord {
  char letter = 0;
  std::string_view number;
  std::uint32_t column = 1;  // of the letter
};

// Text that is not a word.
struct DrillWordFault {
  std::uint32_t column = 1;
  std::string message;
  std::string expected;
};

// `first_column`: the column of the text's first character. Stops at a comment. Returns the first fault, if any.
std::optional<DrillWordFault> scan_drill_words(std::string_view text, std::uint32_t first_column,
                                               std::vector<DrillWord>& words);

}  // namespace passo
