// Sentence: a sentence for people, in a translatable form. Clients in other languages look up their translation by its
// code and insert its arguments; the text is English.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace passo {

using SentenceArguments = std::vector<std::pair<std::string, std::string>>;

struct Sentence {
  std::string code;  // stable, e.g. "machine.asleep"; empty: none, so only the text can be shown
  SentenceArguments arguments = {};
  std::string text = {};  // without a full stop
  friend bool operator==(const Sentence&, const Sentence&) = default;
};

// Replaces each {argument} of the sentence by its value.
std::string filled(std::string_view sentence, const SentenceArguments& arguments);

// One row of a table of sentences: the only place where its words stand.
struct SentenceRow {
  std::string_view code;
  std::string_view text;  // {name} stands for an argument

  Sentence with(SentenceArguments arguments = {}) const;
};

}  // namespace passo
