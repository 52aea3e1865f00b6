#include "passo/interpreter/interpreter.hpp"

#include <charconv>
#include <cmath>
#include <vector>

#include "control_flow.hpp"
#include "evaluation.hpp"
#include "executor.hpp"
#include <fmt/format.h>

namespace passo {

class Interpreter::Implementation {
 public:
  Implementation(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics)
      : options_(options),
        parameters_(state_, symbols_),
        diagnostics_(diagnostics),
        flow_(std::move(reader), symbols_, parameters_, diagnostics, options.idle_passes) {
    state_.units = options.units;
    state_.work = options.start;
    const Reporter reporter(flow_.file(), block_, diagnostics_);
    Executor(state_, reporter, operations_).begin();
  }

  bool next(Operation& operation) {
    while (next_ == operations_.size()) {
      operations_.clear();
      next_ = 0;
      if (ended_) return false;
      if (!process_block()) end();
      if (!operations_.empty()) flow_.note_operation();
    }
    operation = operations_[next_++];
    return true;
  }

  std::uint64_t offset() const { return flow_.main_offset(); }

 private:
  // False at the end of the program.
  bool process_block() {
    if (!flow_.next(block_, options_.block_delete)) return false;
    if (block_.percent) return !std::exchange(after_percent_or_block_, true);
    if (block_.empty()) return true;
    after_percent_or_block_ = true;

    const OperationSource source{.line = block_.line, .line_number = line_number()};
    const Reporter reporter(flow_.file(), block_, diagnostics_);
    Executor executor(state_, reporter, operations_);
    executor.set_source(source);
    for (const Comment& comment : block_.comments) emit_comment(comment, executor);
    const std::size_t before = operations_.size();
    if (!words_.gather(block_, parameters_, reporter) || !assign(reporter) || !executor.execute(words_, source)) {
      operations_.resize(before);
    }
    return !executor.program_ended();
  }

  std::int64_t line_number() const {
    std::int64_t number = -1;
    if (block_.line_number) {
      std::from_chars(block_.line_number->data(), block_.line_number->data() + block_.line_number->size(), number);
    }
    return number;
  }

  void end() {
    ended_ = true;
    operations_.push_back({.what = operation::Reset{}, .source = {}});
    operations_.push_back({.what = operation::Reset{}, .source = {}});
  }

  // All values of a block are those from before it (NIST RS274/NGC 3.3.2.1).
  bool assign(const Reporter& reporter) {
    values_.clear();
    for (const Assignment& assignment : block_.assignments) {
      double index = 0;
      double value = 0;
      if (assignment.index && !evaluate(block_, *assignment.index, parameters_, reporter, index)) return false;
      if (!evaluate(block_, assignment.value, parameters_, reporter, value)) return false;
      values_.emplace_back(index, value);
    }
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!set(block_.assignments[i], values_[i].first, values_[i].second, reporter)) return false;
    }
    return true;
  }

  bool set(const Assignment& assignment, double index, double value, const Reporter& reporter) {
    if (assignment.index && std::fabs(index - std::round(index)) > whole_number_tolerance) {
      return reporter.error("gcode.bad-parameter-number", assignment.span,
                            fmt::format("{} is no number of a parameter", index),
                            fmt::format("a whole number from 1 to {}", Parameters::highest));
    }
    const Parameters::Setting setting = assignment.index ? parameters_.set_numbered(std::llround(index), value)
                                                         : parameters_.set_named(assignment.symbol, value);
    switch (setting) {
      case Parameters::Setting::done: return true;
      case Parameters::Setting::read_only:
        return reporter.error("gcode.read-only-parameter", assignment.span,
                              "this parameter follows the machine's state and cannot be set",
                              "another one, or the code that changes the state");
      case Parameters::Setting::out_of_range: break;
    }
    return reporter.error("gcode.bad-parameter-number", assignment.span, fmt::format("there is no parameter {}", index),
                          fmt::format("a whole number from 1 to {}", Parameters::highest));
  }

  void emit_comment(const Comment& comment, Executor& executor) {
    switch (comment.kind) {
      case Comment::Kind::message: executor.emit(operation::Message{comment.text}); break;
      case Comment::Kind::debug:
      case Comment::Kind::print:
        expanded_ = expand(comment.text);
        executor.emit(operation::Message{expanded_});
        break;
      default: executor.emit(operation::Comment{comment.text}); break;
    }
  }

  // #5 and #<name> in the text of a DEBUG or PRINT comment become their values.
  std::string expand(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
      if (text[i] != '#') {
        out += text[i++];
        continue;
      }
      const std::size_t start = ++i;
      double value = 0;
      bool known = false;
      if (i < text.size() && text[i] == '<') {
        const std::size_t close = std::min(text.find('>', i), text.size() - 1);
        known = parameters_.named(symbols_.intern(text.substr(i + 1, close - i - 1)), value);
        i = close + 1;
      } else {
        std::int64_t number = 0;
        const auto [end, failed] = std::from_chars(text.data() + i, text.data() + text.size(), number);
        known = failed == std::errc() && parameters_.numbered(number, value);
        i = static_cast<std::size_t>(end - text.data());
      }
      out += known ? fmt::format("{:.6f}", value) : "#" + std::string(text.substr(start, i - start));
    }
    return out;
  }

  InterpreterOptions options_;
  ModalState state_;
  SymbolTable symbols_;
  Parameters parameters_;
  Diagnostics& diagnostics_;
  ControlFlow flow_;
  Block block_;
  BlockWords words_;
  std::vector<Operation> operations_;  // of the block at hand; keeps its capacity
  std::vector<std::pair<double, double>> values_;
  std::string expanded_;
  std::size_t next_ = 0;
  bool after_percent_or_block_ = false;
  bool ended_ = false;
};

Interpreter::Interpreter(ProgramReader reader, const InterpreterOptions& options, Diagnostics& diagnostics)
    : implementation_(std::make_unique<Implementation>(std::move(reader), options, diagnostics)) {}
Interpreter::~Interpreter() = default;

bool Interpreter::next(Operation& operation) {
  return implementation_->next(operation);
}
std::uint64_t Interpreter::offset() const {
  return implementation_->offset();
}

}  // namespace passo
