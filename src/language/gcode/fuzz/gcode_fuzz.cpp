// Any bytes as a program: no crash, every place inside its line, parse(print(b)) == b, every value finite or refused.
#include <cmath>
#include <cstdint>
#include <string>

#include "../tests/block_equality.hpp"
#include "kit/require.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/expression.hpp"
#include "passo/gcode/program_reader.hpp"

namespace passo {
namespace {

using test::require;

// Some parameters exist, others do not.
class SomeParameters final : public ParameterValues {
 public:
  bool numbered(std::int64_t number, double& value) const override {
    value = static_cast<double>(number) / 2;
    return number >= 0 && number % 3 != 0;
  }
  bool named(Symbol name, double& value) const override {
    value = name.id;
    return name.id % 2 == 0;
  }
};

bool inside(const Span& span, std::string_view text) {
  return span.column >= 1 && span.length >= 1 && span.column - 1 + std::size_t{span.length} <= text.size();
}

void check_expression(const Block& block, const Expression& expression) {
  require(inside(expression.span, block.text), "an expression outside its line", block.text);
  require(expression.count > 0 && expression.first + expression.count <= block.code.size(), "no code", block.text);
  const Evaluation value = evaluate(block, expression, SomeParameters{});
  if (value) {
    require(std::isfinite(*value), "a value that is not finite", block.text);
  } else {
    require(value.error().kind != EvaluationError::Kind::too_deep, "too deep for the evaluation", block.text);
    require(inside(value.error().span, block.text), "an error outside its line", block.text);
  }
}

void check_block(const Block& block) {
  for (const Word& word : block.words) {
    require(inside(word.span, block.text), "a word outside its line", block.text);
    check_expression(block, word.value);
  }
  for (const Assignment& assignment : block.assignments) {
    require(inside(assignment.span, block.text), "an assignment outside its line", block.text);
    require(assignment.index.has_value() != static_cast<bool>(assignment.symbol), "two targets", block.text);
    if (assignment.index) check_expression(block, *assignment.index);
    check_expression(block, assignment.value);
  }
  for (const BlockComment& comment : block.comments) {
    require(inside(comment.span, block.text), "a comment outside its line", block.text);
  }
  if (!block.control) return;
  require(inside(block.control->span, block.text), "an O-word outside its line", block.text);
  require(block.control->computed_label.has_value() != static_cast<bool>(block.control->label), "label", block.text);
  if (block.control->computed_label) check_expression(block, *block.control->computed_label);
  for (const Expression& argument : block.control->arguments) check_expression(block, argument);
}

void check_program(std::string program) {
  ProgramReader reader = ProgramReader::from_text("fuzz.ngc", std::move(program));
  SymbolTable symbols;
  const BlockParser parser("fuzz.ngc", symbols);
  Diagnostics diagnostics(1'000'000);
  Block block;
  Block again;
  std::string_view text;
  std::uint32_t line = 0;
  while (reader.next_line(text, line, diagnostics)) {
    const std::size_t before = diagnostics.errors();
    if (!parser.parse(text, line, block, diagnostics)) {
      require(diagnostics.errors() == before + 1, "refused without a word", text);
      const Diagnostic& fault = diagnostics.all().back();
      require(inside({fault.place.column, fault.place.length}, text), "a fault outside its line", text);
      require(!fault.message.empty() && fault.message.size() < 200, "message", text);
      static_cast<void>(render(fault, false));
      continue;
    }
    require(diagnostics.errors() == before, "accepted with an error", text);
    check_block(block);
    const std::string printed = print(block, symbols);
    require(parser.parse(printed, line, again, diagnostics), "what was printed does not parse", text);
    require(same_meaning(block, again), "what was printed means something else", text);
    require(print(again, symbols) == printed, "two spellings", text);
  }
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  passo::check_program(std::string(data, data + size));
  return 0;
}
