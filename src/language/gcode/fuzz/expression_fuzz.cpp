// Any bytes as an expression: they are refused, or have a finite value, or a reason for none. Also checks every law of
// arithmetic that holds without knowing the value.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "kit/require.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/expression.hpp"

namespace passo {
namespace {

using test::require;

// #1 … #9 and some names have a value; others have none.
class SomeParameters final : public ParameterValues {
 public:
  bool numbered(std::int64_t number, double& value) const override {
    value = static_cast<double>(number) * 1.25 - 3;
    return number >= 1 && number <= 9;
  }
  bool named(Symbol name, double& value) const override {
    value = -0.5 * name.id;
    return name.id % 2 == 0;
  }
};

class Evaluator {
 public:
  // The value of `X[text]`. Returns false if the text is refused or has no value.
  bool value(const std::string& text, double& value) {
    const std::string line = "X[" + text + "]";
    Diagnostics diagnostics;
    if (!parser_.parse(line, 1, block_, diagnostics)) {
      require(diagnostics.any_error(), "refused without a word", line);
      return false;
    }
    if (block_.words.empty()) return false;
    const Expression& expression = block_.words.front().value;
    const Evaluation found = evaluate(block_, expression, parameters_);
    if (!found) {
      const Span at = found.error().span;
      require(found.error().kind != EvaluationError::Kind::too_deep, "parsed, and too deep", line);
      require(at.column >= 1 && at.column - 1 + std::size_t{at.length} <= line.size(), "a place outside", line);
      return false;
    }
    require(std::isfinite(*found), "a value that is not finite", line);
    alone_ = block_.words.size() == 1 && block_.assignments.empty() && !block_.control && block_.comments.empty() &&
             std::size_t{block_.words.front().span.length} == line.size();
    value = *found;
    return true;
  }
  // Whether the last text was one word from end to end. Such a text may stand in brackets elsewhere.
  bool alone() const { return alone_; }
  std::string printed() const { return print(block_, symbols_); }
  SymbolTable& symbols() { return symbols_; }
  bool reparsed(const std::string& line, double& value) {
    Diagnostics diagnostics;
    require(parser_.parse(line, 1, block_, diagnostics), "what was printed does not parse", line);
    const Evaluation found = evaluate(block_, block_.words.front().value, parameters_);
    value = found ? *found : 0;
    return static_cast<bool>(found);
  }

 private:
  SymbolTable symbols_;
  BlockParser parser_{"fuzz.ngc", symbols_};
  SomeParameters parameters_;
  Block block_;
  bool alone_ = false;
};

void check_expression(const std::string& text) {
  Evaluator evaluator;
  double value = 0;
  if (!evaluator.value(text, value) || !evaluator.alone()) return;
  double again = 0;
  require(evaluator.reparsed(evaluator.printed(), again) && again == value, "printed, it has another value", text);

  // Extra brackets may nest too deep and be refused. Where they are accepted the laws hold.
  double other = 0;
  if (evaluator.value("[" + text + "]", other)) require(other == value, "[x] is not x", text);
  if (evaluator.value("-[" + text + "]", other)) require(other == -value, "-x is not minus x", text);
  if (evaluator.value("[" + text + "]-[" + text + "]", other)) require(other == 0, "x - x is not 0", text);
  if (evaluator.value("[" + text + "]EQ[" + text + "]", other)) require(other == 1, "x EQ x is not 1", text);
  if (evaluator.value("[" + text + "]LT[" + text + "]", other)) require(other == 0, "x LT x is not 0", text);
  if (evaluator.value("ABS[" + text + "]", other)) require(other == std::abs(value), "ABS", text);
  if (evaluator.value("FIX[" + text + "]", other)) require(other <= value && value - other <= 1, "FIX", text);
  if (evaluator.value("FUP[" + text + "]", other)) require(other >= value && other - value <= 1, "FUP", text);
  if (evaluator.value("SIN[" + text + "]", other)) require(std::abs(other) <= 1, "SIN", text);
  const bool has_root = evaluator.value("SQRT[" + text + "]", other);
  if (has_root) require(value >= 0 && std::abs(other * other - value) <= 1e-12 * std::abs(value), "SQRT", text);
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t longest = 2000;
  if (size > longest) return 0;
  std::string text(data, data + size);
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\0') c = ' ';
  }
  passo::check_expression(text);
  return 0;
}
