// evaluate: the value of an expression, with RS274/NGC's operations as LinuxCNC defines them.
//
// The interpreter calls evaluate for every word and assignment that is not a plain number. It never allocates; the
// stack of operands is bounded. The value is finite, or there is an error that tells what to point at.
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
  // Both return false where there is no such parameter.
  virtual bool numbered(std::int64_t number, double& value) const = 0;
  virtual bool named(Symbol name, double& value) const = 0;
  // False: the number has the value 0 because nobody gave it one.
  virtual bool was_set(std::int64_t /*number*/) const { return true; }
};

// A numbered parameter that an expression has read and nobody has set. Number 0: there is none.
struct UnsetParameter {
  std::int64_t number = 0;
  Span span;
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

// The greatest number of operands on the stack, and of brackets, signs and # inside one another. BlockParser refuses
// more.
inline constexpr std::size_t deepest_expression = 64;
// EQ, NE, GE and LE: two numbers are equal if they differ by less than this (LinuxCNC's TOLERANCE_EQUAL; 1e-4 in old
// versions).
inline constexpr double equality_tolerance = 1e-6;
// A number that must be whole (of a parameter or an O-word) may differ from a whole number by this much.
inline constexpr double whole_number_tolerance = 1e-4;

using Evaluation = Result<double, EvaluationError>;
// `unset`: gets the first such parameter, if the caller wants to know of it.
Evaluation evaluate(const Block& block, const Expression& expression, const ParameterValues& parameters,
                    UnsetParameter* unset = nullptr);

}  // namespace passo
