// A warning that points at the words of an operation. Private to activity/.
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

// `file`: the main program, for an operation that names no file.
inline Diagnostic operation_warning(const Operation& operation, const std::string& file, std::string code,
                                    std::string message, std::string expected) {
  return {.severity = Severity::warning,
          .code = std::move(code),
          .file = operation.file.empty() ? file : std::string(operation.file),
          .place = {.line = operation.source.line,
                    .column = operation.word.column,
                    .length = std::max(operation.word.length, 1U)},
          .message = std::move(message),
          .expected = std::move(expected),
          .text = std::string(operation.text)};
}

}  // namespace passo
