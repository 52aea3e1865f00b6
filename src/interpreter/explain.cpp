#include "passo/interpreter/explain.hpp"

#include <algorithm>

#include "block_in_words.hpp"
#include "block_watcher.hpp"

#include "passo/interpreter/canon.hpp"

namespace passo {
namespace {

// Fills in the explanations of the lines of a range while the program runs.
class Explainer final : public BlockWatcher {
 public:
  Explainer(std::string file, LineRange range, Explanations& result)
      : file_(std::move(file)), range_(range), result_(result), unseen_(result.lines.size()) {}

  void before(const Block& block, std::string_view file, const ProgramState& state, const Parameters& parameters,
              const SymbolTable& symbols) override {
    current_ = nullptr;
    if (block.line < range_.first || block.line - range_.first >= result_.lines.size() || file != file_) return;
    Explanation& line = result_.lines[block.line - range_.first];
    if (++line.executions > 1) return;
    if (unseen_ > 0) --unseen_;
    current_ = &line;
    state_before_ = state;
    words_ = word_values(block, parameters, symbols);
    line.before = {state.position, state.machine_position()};
  }

  void after(const ProgramState& state) override {
    if (current_ == nullptr) return;
    current_->after = {state.position, state.machine_position()};
    current_->words = words_in_words(words_, state_before_, state);
    current_->modes = modes_in_words(state_before_, state);
  }

  // The operations of a block come after the block was executed, and before the next block is.
  void add(std::string operation) {
    if (current_ != nullptr) current_->operations.push_back(std::move(operation));
  }
  bool all_seen() const { return unseen_ == 0; }

 private:
  std::string file_;
  LineRange range_;
  Explanations& result_;
  std::size_t unseen_;
  Explanation* current_ = nullptr;
  ProgramState state_before_;
  std::vector<WordValue> words_;
};

// Reads the lines as they are in the file, and counts them.
void read_lines(ProgramReader reader, LineRange range, Explanations& result) {
  Diagnostics ignored;  // the run reports them
  std::string_view text;
  std::uint32_t line = 0;
  while (reader.next_line(text, line, ignored)) {
    // The reader skips a line that cannot be read. Such a line has no text.
    for (std::uint32_t missing = result.lines_in_file + 1; missing <= line; ++missing) {
      if (missing < range.first || missing > range.last) continue;
      Explanation& explanation = result.lines.emplace_back();
      explanation.line = missing;
      if (missing == line) explanation.text = text;
    }
    result.lines_in_file = line;
  }
}

// Without the counter and the N column.
std::string call_alone(const std::string& printed) {
  constexpr std::size_t head = 13;
  const bool counted = printed.size() > head && printed[5] == ' ' && printed[6] == 'N';
  std::string call = counted ? printed.substr(head) : printed;
  if (!call.empty() && call.back() == '\n') call.pop_back();
  return call;
}

}  // namespace

Explanations explain(ProgramReader program, const InterpreterOptions& options, LineRange range,
                     Diagnostics& diagnostics, const ExplainLimits& limits) {
  Explanations result;
  const std::string file = program.name();
  read_lines(program.again(), range, result);
  Explainer explainer(file, range, result);
  Interpreter interpreter(std::move(program), options, diagnostics);
  interpreter.watch(explainer);

  CanonPrinter printer;
  Operation operation;
  std::string printed;
  std::uint64_t left = limits.operations;
  bool counting = false;
  while (interpreter.next(operation)) {
    printed.clear();
    printer.print(operation, printed);
    // Resets belong to no block: they open and close the program.
    if (!std::holds_alternative<operation::Reset>(operation.what)) explainer.add(call_alone(printed));
    if (!counting && explainer.all_seen()) {
      counting = true;
      left = std::min(left, limits.further_operations);
    }
    if (--left == 0) {
      result.whole_run = false;
      break;
    }
  }
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.file != file || finding.place.line < range.first) continue;
    if (finding.place.line - range.first >= result.lines.size()) continue;
    result.lines[finding.place.line - range.first].findings.push_back(finding);
  }
  return result;
}

}  // namespace passo
