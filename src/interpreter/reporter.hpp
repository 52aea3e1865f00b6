// Reporter: says what is wrong in the block that is being read, with its line and the place in it.
#pragma once

#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/block.hpp"
#include "passo/gcode/expression.hpp"

namespace passo {

class Reporter {
 public:
  explicit Reporter(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // What follows is about this block of this file, until the next call. Both are borrowed.
  void look_at(const Block& block, const std::string& file) {
    block_ = &block;
    file_ = &file;
  }

  void error(std::string_view code, Span span, std::string message, std::string expected = {});
  void warning(std::string_view code, Span span, std::string message, std::string expected = {});
  // About another line than the block's own.
  void error_at(std::string_view code, std::uint32_t line, std::string_view text, Span span, std::string message,
                std::string expected);
  // An expression that has no value.
  void error(const EvaluationError& error);

  // What the file says there.
  std::string quote(Span span) const;
  const Block& block() const { return *block_; }
  std::string_view file() const { return file_ == nullptr ? std::string_view() : *file_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  bool full() const { return diagnostics_.full(); }

 private:
  void add(Severity severity, std::string_view code, std::uint32_t line, std::string_view text, Span span,
           std::string message, std::string expected);

  Diagnostics& diagnostics_;
  const Block* block_ = nullptr;
  const std::string* file_ = nullptr;
};

// A number as a person writes it: "2.5", not "2.500000".
std::string plain_number(double value);

}  // namespace passo
