// Reporter: turns what is wrong in the block at hand into a Diagnostic.
#pragma once

#include <string>
#include <utility>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/block.hpp"

namespace passo {

class Reporter {
 public:
  Reporter(std::string file, const Block& block, Diagnostics& diagnostics)
      : file_(std::move(file)), block_(block), diagnostics_(diagnostics) {}

  // Always false, so that a check can end with `return reporter.error(…)`.
  bool error(const char* code, Span span, std::string message, std::string expected = "") const {
    report(Severity::error, code, span, std::move(message), std::move(expected));
    return false;
  }
  void warning(const char* code, Span span, std::string message, std::string expected = "") const {
    report(Severity::warning, code, span, std::move(message), std::move(expected));
  }
  const std::string& file() const { return file_; }

 private:
  void report(Severity severity, const char* code, Span span, std::string message, std::string expected) const {
    diagnostics_.add({.severity = severity,
                      .code = code,
                      .file = file_,
                      .place = {.line = block_.line, .column = span.column, .length = span.length},
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = std::string(block_.text)});
  }

  std::string file_;
  const Block& block_;
  Diagnostics& diagnostics_;
};

}  // namespace passo
