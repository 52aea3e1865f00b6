// A block's words and the machine's modes, each said in words with its value and units.
#pragma once

#include <vector>

#include "parameters.hpp"
#include "program_state.hpp"

#include "passo/gcode/block.hpp"
#include "passo/gcode/symbols.hpp"
#include "passo/interpreter/explain.hpp"

namespace passo {

// A word or parameter of a block, with its value when the block began. The block itself may change what the value comes
// from.
struct WordValue {
  std::string word;  // as written
  char letter = 0;   // of a word; 0: something else, and `meaning` says what
  double value = 0;
  bool known = false;  // it has a value
  std::string meaning;
};
std::vector<WordValue> word_values(const Block& block, const Parameters& parameters, const SymbolTable& symbols);

// `before` and `after` are the states around the block: words are meant in the units of the state after.
std::vector<Explanation::Word> words_in_words(const std::vector<WordValue>& words, const ProgramState& before,
                                              const ProgramState& after);
std::vector<Explanation::Mode> modes_in_words(const ProgramState& before, const ProgramState& after);

}  // namespace passo
