// OperationWatcher: the base of those who watch the operations of a program, in order, and warn of some.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

class OperationWatcher {
 protected:
  // `file`: the main program, for an operation that names no file. `diagnostics` outlives this.
  OperationWatcher(std::string file, Diagnostics& diagnostics) : diagnostics_(diagnostics), file_(std::move(file)) {}
  ~OperationWatcher() = default;

  // It points at the words of the operation.
  Diagnostic warning(const Operation& operation, std::string code, FindingWords message, FindingWords expected) const {
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

  // True: a warning of this kind is kept already, and the operation's line is noted with it.
  bool is_noted(const Operation& operation, std::string_view code) const {
    return diagnostics_.count_repeated(code, operation.file.empty() ? file_ : operation.file, operation.source.line);
  }
  void warn(const Operation& operation, std::string_view code, const SentenceRow& message,
            const SentenceRow& expected) const {
    if (is_noted(operation, code)) return;
    diagnostics_.add_certain(warning(operation, std::string(code), message, expected));
  }

  Diagnostics& diagnostics_;

 private:
  std::string file_;
};

}  // namespace passo
