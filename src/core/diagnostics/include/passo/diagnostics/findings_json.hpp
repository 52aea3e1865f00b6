// Findings as JSON, in the same format for every command. The API omits fields that a client of one program does not
// need.
#pragma once

#include <span>

#include <nlohmann/json.hpp>

#include "passo/diagnostics/shown_location.hpp"

namespace passo {

inline nlohmann::ordered_json findings_json(std::span<const Diagnostic> findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Diagnostic& finding : findings) {
    nlohmann::ordered_json calls = nlohmann::ordered_json::array();
    for (const CallLocation& call : finding.calls) {
      calls.push_back({{"sub", call.sub}, {"file", call.file}, {"line", call.line}});
    }
    const SourceLocation place = shown_location(finding);
    list.push_back({{"severity", finding.severity == Severity::error ? "error" : "warning"},
                    {"code", finding.code},
                    {"file", finding.file},
                    {"line", place.line},
                    {"column", place.column},
                    {"length", place.length},
                    {"message", finding.message},
                    {"expected", finding.expected},
                    {"rule", finding.rule},
                    {"calls", std::move(calls)},
                    {"more_lines", finding.more_lines}});
  }
  return list;
}

}  // namespace passo
