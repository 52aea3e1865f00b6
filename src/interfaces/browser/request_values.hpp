// What the functions of the browser share: values of a request, and findings as JSON with their sentences.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "passo/diagnostics/findings_json.hpp"

namespace passo {

using CheckJson = nlohmann::ordered_json;

// A value of the request, or what it is if it lacks or is of another kind.
template <class Value>
Value value_of(const CheckJson& request, const char* key, Value otherwise) {
  const auto found = request.find(key);
  if (found == request.end()) return otherwise;
  if constexpr (std::is_same_v<Value, bool>) {
    return found->is_boolean() ? found->template get<bool>() : otherwise;
  } else {
    return found->is_string() ? found->template get<std::string>() : otherwise;
  }
}

inline std::string written(const CheckJson& answer) {
  return answer.dump(-1, ' ', false, CheckJson::error_handler_t::replace);
}

// With the line of the file, and the words in a form that the page can translate.
inline CheckJson findings_with_sentences(const Diagnostics& findings) {
  const auto sentence_json = [](const FindingWords& words) {
    const Sentence sentence = words.sentence();
    CheckJson arguments = CheckJson::object();
    for (const auto& [name, value] : sentence.arguments) arguments[name] = value;
    return CheckJson{{"code", sentence.code}, {"arguments", std::move(arguments)}};
  };
  CheckJson list = findings_json(findings.all());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Diagnostic& finding = findings.all()[i];
    list[i]["text"] = finding.text;
    list[i]["message_sentence"] = sentence_json(finding.message);
    list[i]["expected_sentence"] = sentence_json(finding.expected);
  }
  return list;
}

}  // namespace passo
