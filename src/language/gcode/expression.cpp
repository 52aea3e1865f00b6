#include "passo/gcode/expression.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

using Kind = EvaluationError::Kind;

constexpr double radians_per_degree = std::numbers::pi / 180;
constexpr double degrees_per_radian = 180 / std::numbers::pi;

double truth(bool value) {
  return value ? 1 : 0;
}

bool is_equal(double a, double b) {
  return std::abs(a - b) < equality_tolerance;
}

// The result of an operation: a number, or an error and the operand that caused it.
struct Outcome {
  double value = 0;
  bool failed = false;
  Kind kind = Kind::not_finite;
};

Outcome failure(Kind kind, double operand) {
  return {operand, true, kind};
}

// As in LinuxCNC, MOD is never negative.
Outcome modulo(double a, double b) {
  if (b == 0) return failure(Kind::division_by_zero, b);
  const double rest = std::fmod(a, b);
  if (rest == 0) return {0};  // not -0
  return {rest < 0 ? rest + std::abs(b) : rest};
}

Outcome power(double base, double exponent) {
  if (base < 0 && std::floor(exponent) != exponent) return failure(Kind::domain, base);
  if (base == 0 && exponent < 0) return failure(Kind::division_by_zero, base);
  return {std::pow(base, exponent)};
}

Outcome binary(ExpressionOp op, double a, double b) {
  switch (op) {
    case ExpressionOp::power: return power(a, b);
    case ExpressionOp::multiply: return {a * b};
    case ExpressionOp::divide: return b == 0 ? failure(Kind::division_by_zero, b) : Outcome{a / b};
    case ExpressionOp::modulo: return modulo(a, b);
    case ExpressionOp::add: return {a + b};
    case ExpressionOp::subtract: return {a - b};
    case ExpressionOp::equal: return {truth(is_equal(a, b))};
    case ExpressionOp::not_equal: return {truth(!is_equal(a, b))};
    case ExpressionOp::greater: return {truth(a > b)};
    case ExpressionOp::greater_equal: return {truth(a > b || is_equal(a, b))};
    case ExpressionOp::less: return {truth(a < b)};
    case ExpressionOp::less_equal: return {truth(a < b || is_equal(a, b))};
    case ExpressionOp::bit_and: return {truth(a != 0 && b != 0)};
    case ExpressionOp::bit_or: return {truth(a != 0 || b != 0)};
    case ExpressionOp::bit_xor: return {truth((a != 0) != (b != 0))};
    case ExpressionOp::atan: return {std::atan2(a, b) * degrees_per_radian};
    default: break;
  }
  assert(false && "not a binary operation");
  return failure(Kind::not_finite, a);
}

Outcome unary(ExpressionOp op, double a) {
  switch (op) {
    case ExpressionOp::negate: return {-a};
    case ExpressionOp::abs: return {std::abs(a)};
    case ExpressionOp::acos:
      return std::abs(a) > 1 ? failure(Kind::domain, a) : Outcome{std::acos(a) * degrees_per_radian};
    case ExpressionOp::asin:
      return std::abs(a) > 1 ? failure(Kind::domain, a) : Outcome{std::asin(a) * degrees_per_radian};
    case ExpressionOp::cos: return {std::cos(a * radians_per_degree)};
    case ExpressionOp::exp: return {std::exp(a)};
    case ExpressionOp::fix: return {std::floor(a)};
    case ExpressionOp::fup: return {std::ceil(a)};
    case ExpressionOp::ln: return a <= 0 ? failure(Kind::domain, a) : Outcome{std::log(a)};
    case ExpressionOp::round: return {std::round(a)};
    case ExpressionOp::sin: return {std::sin(a * radians_per_degree)};
    case ExpressionOp::sqrt: return a < 0 ? failure(Kind::domain, a) : Outcome{std::sqrt(a)};
    case ExpressionOp::tan: return {std::tan(a * radians_per_degree)};
    default: break;
  }
  assert(false && "not a unary operation");
  return failure(Kind::not_finite, a);
}

// The value of #n, or with `exists` whether #n exists.
Outcome numbered(const ParameterValues& parameters, double n, bool exists) {
  constexpr double largest = 1e15;  // whole numbers up to here are exact, and fit std::int64_t
  const double whole = std::round(n);
  if (std::abs(n - whole) > whole_number_tolerance || std::abs(whole) > largest) {
    return failure(Kind::bad_parameter_number, n);
  }
  double value = 0;
  const bool found = parameters.numbered(static_cast<std::int64_t>(whole), value);
  if (exists) return {truth(found)};
  return found ? Outcome{value} : failure(Kind::unknown_parameter, whole);
}

Outcome named(const ParameterValues& parameters, Symbol name, bool exists) {
  double value = 0;
  const bool found = parameters.named(name, value);
  if (exists) return {truth(found)};
  return found ? Outcome{value} : failure(Kind::unknown_parameter, 0);
}

bool has_two_operands(ExpressionOp op) {
  return (op >= ExpressionOp::power && op <= ExpressionOp::bit_xor) || op == ExpressionOp::atan;
}

}  // namespace

Evaluation evaluate(const Block& block, const Expression& expression, const ParameterValues& parameters,
                    UnsetParameter* unset) {
  assert(expression.count > 0 && expression.first + expression.count <= block.code.size());
  const Instruction* instruction = block.code.data() + expression.first;
  if (expression.count == 1 && instruction->op == ExpressionOp::number) return instruction->number;

  std::array<double, deepest_expression> stack;
  std::size_t depth = 0;
  for (const Instruction* const end = instruction + expression.count; instruction != end; ++instruction) {
    Outcome outcome;
    switch (instruction->op) {
      case ExpressionOp::number: outcome = {instruction->number}; break;
      case ExpressionOp::named_parameter: outcome = named(parameters, instruction->symbol, false); break;
      case ExpressionOp::exists_named: outcome = named(parameters, instruction->symbol, true); break;
      case ExpressionOp::parameter: {
        const double number = stack[--depth];
        outcome = numbered(parameters, number, false);
        if (unset == nullptr || unset->number != 0 || outcome.failed) break;
        const auto whole = static_cast<std::int64_t>(std::round(number));
        if (!parameters.was_set(whole)) *unset = {whole, instruction->span};
        break;
      }
      case ExpressionOp::exists_parameter: outcome = numbered(parameters, stack[--depth], true); break;
      default:
        if (has_two_operands(instruction->op)) {
          depth -= 2;
          outcome = binary(instruction->op, stack[depth], stack[depth + 1]);
        } else {
          outcome = unary(instruction->op, stack[--depth]);
        }
    }
    if (outcome.failed) return Failure{EvaluationError{outcome.kind, instruction->span, outcome.value}};
    if (!std::isfinite(outcome.value)) {
      return Failure{EvaluationError{Kind::not_finite, instruction->span, outcome.value}};
    }
    if (depth == stack.size()) return Failure{EvaluationError{Kind::too_deep, instruction->span, 0}};
    stack[depth++] = outcome.value;
  }
  assert(depth == 1);
  return stack[0];
}

}  // namespace passo
