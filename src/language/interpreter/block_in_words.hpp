// Describes a block's words and the active modes as text, with values and units.
#pragma once

#include <vector>

#include "parameters.hpp"
#include "program_state.hpp"

#include "passo/gcode/block.hpp"
#include "passo/gcode/symbols.hpp"
#include "passo/interpreter/explain.hpp"

namespace passo {

// A word or parameter of a block, with its value before the block was executed, because the block itself may change the
// parameters in it.
struct WordValue {
  std::string word;  // as written
  char letter = 0;   // letter of a word; 0: something else, described by `meaning`
  double value = 0;
  bool known = false;  // whether it has a value
  std::string meaning;
};
std::vector<WordValue> word_values(const Block& block, const Parameters& parameters, const SymbolTable& symbols);

// `before` and `after` are the states before and after the block: words have the units of the state after.
std::vector<Explanation::Word> words_in_words(const std::vector<WordValue>& words, const ProgramState& before,
                                              const ProgramState& after);
std::vector<Explanation::Mode> modes_in_words(const ProgramState& before, const ProgramState& after);

}  // namespace passo
