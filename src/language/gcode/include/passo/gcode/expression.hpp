// evaluate: computes the value of an expression, with RS274/NGC's operations as LinuxCNC defines them.
//
// The interpreter calls it for every word and assignment that is not a plain number. It never allocates memory; the
// operand stack is bounded. The result is a finite value, or an error with the part of the line to mark.
#pragma once

#include <cstddef>
#include <cstdint>

#include "passo/base/result.hpp"
#include "passo/gcode/block.hpp"

namespace passo {

// The parameters that an expression reads. The interpreter implements this.
class ParameterValues {
 public:
  virtual ~ParameterValues() = default;
  // Both return false if there is no such parameter, and otherwise set `value`.
  virtual bool numbered(std::int64_t number, double& value) const = 0;
  virtual bool named(Symbol name, double& value) const = 0;
  // Returns false if the parameter is 0 because it was never set.
  virtual bool was_set(std::int64_t /*number*/) const { return true; }
};

// A numbered parameter that was read but never set. Number 0: none.
struct UnsetParameter {
  std::int64_t number = 0;
  Span span;
};

// Why an expression has no value, and the part of the line to mark.
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
  double operand = 0;  // the invalid number
};

// The largest number of operands on the stack, and the deepest nesting of brackets, signs and #. BlockParser rejects
// more.
inline constexpr std::size_t deepest_expression = 64;
// EQ, NE, GE and LE: two numbers are equal if they differ by less than this (LinuxCNC's TOLERANCE_EQUAL; 1e-4 in old
// versions).
inline constexpr double equality_tolerance = 1e-6;
// A number that must be whole (of a parameter or an O-word) may differ from a whole number by this much.
inline constexpr double whole_number_tolerance = 1e-4;

using Evaluation = Result<double, EvaluationError>;
// `unset`: receives the first parameter that was never set, unless null.
Evaluation evaluate(const Block& block, const Expression& expression, const ParameterValues& parameters,
                    UnsetParameter* unset = nullptr);

}  // namespace passo
