// Computing the value of an expression. Never allocates; the depth of the stack is bounded.
#pragma once

#include <span>
#include <string>

#include "passo/base/result.hpp"
#include "passo/gcode/block.hpp"

namespace passo {

// Where parameters live: the interpreter's side of an expression.
class ParameterValues {
 public:
  virtual ~ParameterValues() = default;
  // False where there is no such parameter.
  virtual bool numbered(std::int64_t number, double& value) const = 0;
  virtual bool named(Symbol name, double& value) const = 0;
};

// Why an expression has no value, and what to point at.
struct EvaluationError {
  enum class Kind : std::uint8_t {
    unknown_parameter,     // #n or #<name> that was never set
    bad_parameter_number,  // not a whole number
    division_by_zero,
    domain,      // SQRT of a negative number, LN of zero, ACOS of 2, a power without a real value
    not_finite,  // overflow
    too_deep,
  };
  Kind kind;
  Span span;
  double operand = 0;  // the number that was wrong
};

inline constexpr std::size_t deepest_expression = 64;  // operands on the stack

using Evaluation = Result<double, EvaluationError>;
Evaluation evaluate(const Block& block, const Expression& expression, const ParameterValues& parameters);

}  // namespace passo
