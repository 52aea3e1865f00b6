// ProgramWords: the words and the comment of one line of G-code. Private to post_processor/.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct ProgramWord {
  char letter = 0;          // a capital
  std::string_view digits;  // as written; an expression or a parameter: empty
  double value = 0;
  std::size_t column = 0;  // from 1
};

struct ProgramWords {
  std::vector<ProgramWord> words = {};
  std::string_view comment = {};  // without its brackets
  std::size_t bad_column = 0;     // of the first character that belongs to no word; 0: none

  const ProgramWord* find(char letter) const;
  // Returns whether the line has this G or M word, e.g. ('G', 81).
  bool has(char letter, double value) const;
};

// The words refer to `line`.
void read_words(std::string_view line, ProgramWords& words);

// "04" and "4." are "4", "38.2" is itself: as the lists of a controller have it.
std::string code_number(double value);

}  // namespace passo
