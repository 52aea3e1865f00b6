// Reporter: reports errors in the block being read, with the line and the position in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "consequential_errors.hpp"

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/block.hpp"
#include "passo/gcode/expression.hpp"

namespace passo {

// The interface to the stack of running subroutines.
class CallStack {
 public:
  virtual ~CallStack() = default;
  // Returns the calls, the innermost first.
  virtual std::vector<CallLocation> calls() const = 0;
};

class Reporter {
 public:
  explicit Reporter(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Sets the block and the file of the following reports. Both must stay valid until the next call.
  void set_block(const Block& block, const std::string& file) {
    block_ = &block;
    file_ = &file;
  }

  // Sets another block of that file.
  void set_block(const Block& block) { block_ = &block; }

  // Sets the stack from which diagnostics get their chain of calls. It must stay valid.
  void set_call_stack(const CallStack& stack) { stack_ = &stack; }

  void error(std::string_view code, Span span, FindingWords message, FindingWords expected = {});
  void warning(std::string_view code, Span span, FindingWords message, FindingWords expected = {});
  // Reports an error in a line other than the block's own.
  void error_at(std::string_view code, std::uint32_t line, std::string_view text, Span span, FindingWords message,
                FindingWords expected);
  void warning_at(std::string_view code, std::uint32_t line, std::string_view text, Span span, FindingWords message,
                  FindingWords expected);
  // Reports an expression that has no value.
  void error(const EvaluationError& error);
  void warn_of(const UnsetParameter& unset);
  void warn_of_blank(Span number);  // Warns about a blank between the digits of a number.

  // Reports errors found while the line was read.
  void pass_on(Diagnostics& faults);

  // Makes each line be judged separately, without suppressing consequences of earlier errors.
  void judge_lines_alone() { judges_alone_ = true; }
  // Notes that the block failed, so what it would have set is in doubt.
  void doubt() {
    if (!judges_alone_) doubts_.scan(block_->text);
  }
  ConsequentialErrors& doubts() { return doubts_; }

  // Counts the repetition of an error that was already reported.
  void meet_again() { ++errors_; }
  // Returns the number of errors, including repetitions.
  std::uint64_t errors() const { return errors_; }

  // Returns the text of the block at this position, shortened if it is long.
  std::string quote(Span span) const;
  const Block& block() const { return *block_; }
  std::string_view file() const { return file_ == nullptr ? std::string_view() : *file_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  bool full() const { return diagnostics_.full(); }

 private:
  void add(Severity severity, std::string_view code, std::uint32_t line, std::string_view text, Span span,
           FindingWords message, FindingWords expected);
  bool is_kept(std::string_view code, std::uint32_t line, Span span) const;
  std::vector<CallLocation> calls() const;

  Diagnostics& diagnostics_;
  const Block* block_ = nullptr;
  const std::string* file_ = nullptr;
  const CallStack* stack_ = nullptr;
  std::uint64_t errors_ = 0;
  ConsequentialErrors doubts_;
  bool judges_alone_ = false;
};

// Formats a number in plain style: "2.5", not "2.500000".
std::string plain_number(double value);
// Returns e.g. "1 degree", "2.5 degrees".
std::string number_and_noun(double value, std::string_view noun);

}  // namespace passo
