// evaluate: the value of an expression, with RS274/NGC's operations as LinuxCNC defines them.
//
// The interpreter calls it for every word and assignment that is not a plain number. Never allocates; the stack of
// operands is bounded. The value is finite, or there is an error that says what to point at.
#pragma once

#include <cstddef>
#include <cstdint>

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

// Operands on the stack, and brackets, signs and # inside one another. BlockParser refuses what goes deeper.
inline constexpr std::size_t deepest_expression = 64;
// EQ and NE: two numbers are equal when they differ by less (LinuxCNC's TOLERANCE_EQUAL; 1e-4 in old versions).
inline constexpr double equality_tolerance = 1e-6;
// A number that must be whole (of a parameter, of an O-word) may differ from it by this much.
inline constexpr double whole_number_tolerance = 1e-4;

using Evaluation = Result<double, EvaluationError>;
Evaluation evaluate(const Block& block, const Expression& expression, const ParameterValues& parameters);

}  // namespace passo
