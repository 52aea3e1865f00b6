// OperationWatcher: the base class of observers that check a program's operations in order and add warnings.
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
  // `file`: the main program, for operations without a file name. `diagnostics` must outlive this object.
  OperationWatcher(std::string file, Diagnostics& diagnostics) : diagnostics_(diagnostics), file_(std::move(file)) {}
  ~OperationWatcher() = default;

  // Returns a warning at the source position of the operation.
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

  // Returns true if a warning of this code is already kept; the operation's line is added to it.
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
