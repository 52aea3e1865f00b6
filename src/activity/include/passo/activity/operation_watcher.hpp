// OperationWatcher: the base of those who watch the operations of a program, in order, and warn of some.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

class OperationWatcher {
 protected:
  // `file`: the main program, for an operation that names no file. `diagnostics` outlives this.
  OperationWatcher(std::string file, Diagnostics& diagnostics) : diagnostics_(diagnostics), file_(std::move(file)) {}
  ~OperationWatcher() = default;

  template <class... Whats>
  static bool is_any_of(const Operation& operation) {
    return (std::holds_alternative<Whats>(operation.what) || ...);
  }
  // It points at the words of the operation.
  Diagnostic warning(const Operation& operation, std::string code, std::string message, std::string expected) const {
    return {.severity = Severity::warning,
            .code = std::move(code),
            .file = operation.file.empty() ? file_ : std::string(operation.file),
            .place = {.line = operation.source.line,
                      .column = operation.word.column,
                      .length = std::max(operation.word.length, 1U)},
            .message = std::move(message),
            .expected = std::move(expected),
            .text = std::string(operation.text)};
  }

  Diagnostics& diagnostics_;

 private:
  std::string file_;
};

}  // namespace passo
