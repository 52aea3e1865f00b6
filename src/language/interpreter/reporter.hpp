// Reporter: reports what is wrong in the block that is being read, with its line and the place in the line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "doubts.hpp"

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/block.hpp"
#include "passo/gcode/expression.hpp"

namespace passo {

// The interface that knows which subs are running.
class CallStack {
 public:
  virtual ~CallStack() = default;
  // The innermost first.
  virtual std::vector<CallPlace> calls() const = 0;
};

class Reporter {
 public:
  explicit Reporter(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Until the next call, reports are about this block of this file. Both are borrowed.
  void set_block(const Block& block, const std::string& file) {
    block_ = &block;
    file_ = &file;
  }

  // The same for another block of that file.
  void set_block(const Block& block) { block_ = &block; }

  // Sets the stack that tells through which calls the program came to a finding. Borrowed.
  void set_call_stack(const CallStack& stack) { stack_ = &stack; }

  void error(std::string_view code, Span span, FindingWords message, FindingWords expected = {});
  void warning(std::string_view code, Span span, FindingWords message, FindingWords expected = {});
  // Report about a line other than the block's own.
  void error_at(std::string_view code, std::uint32_t line, std::string_view text, Span span, FindingWords message,
                FindingWords expected);
  void warning_at(std::string_view code, std::uint32_t line, std::string_view text, Span span, FindingWords message,
                  FindingWords expected);
  // Reports an expression that has no value.
  void error(const EvaluationError& error);
  void warn_of(const UnsetParameter& unset);
  void warn_of_blank(Span number);  // between the digits of a number

  // Reports what was found while the line was read.
  void pass_on(Diagnostics& faults);

  // Each line is judged by itself, and none as the consequence of an earlier one.
  void judge_lines_alone() { judges_alone_ = true; }
  // The block failed, and what it would have set is in doubt.
  void doubt() {
    if (!judges_alone_) doubts_.scan(block_->text);
  }
  Doubts& doubts() { return doubts_; }

  // Counts an error that was reported before and is met again.
  void meet_again() { ++errors_; }
  // How often an error was met, also one that was reported before.
  std::uint64_t errors() const { return errors_; }

  // The text of the block at this place, shortened if it is long.
  std::string quote(Span span) const;
  const Block& block() const { return *block_; }
  std::string_view file() const { return file_ == nullptr ? std::string_view() : *file_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  bool full() const { return diagnostics_.full(); }

 private:
  void add(Severity severity, std::string_view code, std::uint32_t line, std::string_view text, Span span,
           FindingWords message, FindingWords expected);
  bool is_kept(std::string_view code, std::uint32_t line, Span span) const;
  std::vector<CallPlace> calls() const;

  Diagnostics& diagnostics_;
  const Block* block_ = nullptr;
  const std::string* file_ = nullptr;
  const CallStack* stack_ = nullptr;
  std::uint64_t errors_ = 0;
  Doubts doubts_;
  bool judges_alone_ = false;
};

// A number as a person writes it: "2.5", not "2.500000".
std::string plain_number(double value);
// "1 degree", "2.5 degrees".
std::string number_and_noun(double value, std::string_view noun);

}  // namespace passo
