#include "passo/base/sentence.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace passo {

// In one pass, because the value of an argument may have braces itself.
std::string filled(std::string_view sentence, const SentenceArguments& arguments) {
  std::string words;
  for (std::size_t at = 0; at < sentence.size();) {
    const std::size_t open = std::min(sentence.find('{', at), sentence.size());
    const std::size_t close = std::min(sentence.find('}', open), sentence.size());
    words += sentence.substr(at, open - at);
    if (open == sentence.size()) break;
    const std::string_view name = sentence.substr(open + 1, close - open - 1);
    const auto found = std::ranges::find(arguments, name, &SentenceArguments::value_type::first);
    if (found != arguments.end()) words += found->second;
    at = close + 1;
  }
  return words;
}

Sentence SentenceRow::with(SentenceArguments arguments) const {
  std::string words = filled(text, arguments);
  return {.code = std::string(code), .arguments = std::move(arguments), .text = std::move(words)};
}

}  // namespace passo
