// FindingWords: the words of a finding, with what a client needs to say them in another language.
#pragma once

#include <string>
#include <utility>

#include "passo/base/sentence.hpp"

namespace passo {

// A text, for whoever only shows it. Made of a Sentence or of a row, it keeps the code and the arguments.
class FindingWords : public std::string {
 public:
  FindingWords() = default;
  FindingWords(const char* text) : std::string(text) {}  // NOLINT: implicit on purpose, as are all here
  FindingWords(std::string text) noexcept : std::string(std::move(text)) {}  // NOLINT
  FindingWords(Sentence sentence)                                            // NOLINT
      : std::string(std::move(sentence.text)),
        code_(std::move(sentence.code)),
        arguments_(std::move(sentence.arguments)) {}
  FindingWords(const SentenceRow& row) : FindingWords(row.with()) {}  // NOLINT

  // Its code is empty: only the text can be shown.
  Sentence sentence() const { return {.code = code_, .arguments = arguments_, .text = *this}; }

 private:
  std::string code_;
  SentenceArguments arguments_;
};

// The arguments of a sentence that holds a whole other one: its text as {name}, and its code and arguments, so that it
// can be translated, too.
SentenceArguments held_as(const std::string& name, const FindingWords& words);

}  // namespace passo
