#include "evaluation.hpp"

#include <fmt/format.h>

namespace passo {
namespace {

bool report(const EvaluationError& error, const Block& block, const Reporter& reporter) {
  const std::string_view place =
      error.span.column > 0 ? block.text.substr(error.span.column - 1, error.span.length) : std::string_view();
  switch (error.kind) {
    case EvaluationError::Kind::unknown_parameter:
      return reporter.error("gcode.unknown-parameter", error.span, fmt::format("{} has no value yet", place),
                            "a parameter that was set before");
    case EvaluationError::Kind::bad_parameter_number:
      return reporter.error("gcode.bad-parameter-number", error.span,
                            fmt::format("{} is no number of a parameter", error.operand),
                            fmt::format("a whole number from 1 to {}", Parameters::highest));
    case EvaluationError::Kind::division_by_zero:
      return reporter.error("gcode.division-by-zero", error.span, "division by zero");
    case EvaluationError::Kind::domain:
      return reporter.error("gcode.no-real-value", error.span,
                            fmt::format("{} of {} has no real value", place, error.operand));
    case EvaluationError::Kind::not_finite:
      return reporter.error("gcode.number-out-of-range", error.span, "the result is too large for a number");
    case EvaluationError::Kind::too_deep: break;
  }
  return reporter.error("gcode.expression-too-deep", error.span, "the expression is too deep",
                        fmt::format("at most {} operands at a time", deepest_expression));
}

}  // namespace

bool evaluate(const Block& block, const Expression& expression, const Parameters& parameters, const Reporter& reporter,
              double& value) {
  const Instruction& first = block.code[expression.first];
  if (expression.count == 1 && first.op == ExpressionOp::number) {  // nearly always
    value = first.number;
    return true;
  }
  const Evaluation result = evaluate(block, expression, static_cast<const ParameterValues&>(parameters));
  if (!result) return report(result.error(), block, reporter);
  value = *result;
  return true;
}

}  // namespace passo
