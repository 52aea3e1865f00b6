#include "passo/diagnostics/finding_words.hpp"

namespace passo {

SentenceArguments held_as(const std::string& name, const FindingWords& words) {
  const Sentence held = words.sentence();
  SentenceArguments arguments = {{name, held.text}};
  if (held.code.empty()) return arguments;
  arguments.emplace_back(name + ".code", held.code);
  for (const auto& [inner, value] : held.arguments) arguments.emplace_back(name + ".arguments." + inner, value);
  return arguments;
}

}  // namespace passo
