// LineParser's values: numbers, expressions, parameters, functions. One pass makes postfix code of them.
#include <array>

#include "line_parser.hpp"
#include "number.hpp"

#include "passo/gcode/expression.hpp"

namespace passo {
namespace {

struct Operator {
  ExpressionOp op = ExpressionOp::number;
  int precedence = 0;  // 0: no operator
  std::string_view name;
};

// LinuxCNC's precedences. All operators group from the left, ** too: [2**3**2] is 64.
constexpr int lowest = 1;
constexpr std::array word_operators = {
    Operator{ExpressionOp::bit_and, 1, "AND"},      Operator{ExpressionOp::bit_or, 1, "OR"},
    Operator{ExpressionOp::bit_xor, 1, "XOR"},      Operator{ExpressionOp::equal, 2, "EQ"},
    Operator{ExpressionOp::not_equal, 2, "NE"},     Operator{ExpressionOp::greater, 2, "GT"},
    Operator{ExpressionOp::greater_equal, 2, "GE"}, Operator{ExpressionOp::less, 2, "LT"},
    Operator{ExpressionOp::less_equal, 2, "LE"},    Operator{ExpressionOp::modulo, 4, "MOD"},
};
constexpr Operator plus{ExpressionOp::add, 3, "+"};
constexpr Operator minus{ExpressionOp::subtract, 3, "-"};
constexpr Operator divided_by{ExpressionOp::divide, 4, "/"};
constexpr Operator times{ExpressionOp::multiply, 4, "*"};
constexpr Operator to_the_power{ExpressionOp::power, 5, "**"};

struct Function {
  std::string_view name;
  ExpressionOp op;
};

constexpr std::array functions = {
    Function{"ABS", ExpressionOp::abs},   Function{"ACOS", ExpressionOp::acos},
    Function{"ASIN", ExpressionOp::asin}, Function{"ATAN", ExpressionOp::atan},
    Function{"COS", ExpressionOp::cos},   Function{"EXP", ExpressionOp::exp},
    Function{"FIX", ExpressionOp::fix},   Function{"FUP", ExpressionOp::fup},
    Function{"LN", ExpressionOp::ln},     Function{"ROUND", ExpressionOp::round},
    Function{"SIN", ExpressionOp::sin},   Function{"SQRT", ExpressionOp::sqrt},
    Function{"TAN", ExpressionOp::tan},   Function{"EXISTS", ExpressionOp::exists_parameter},
};

const char* skip_blanks(const char* at, const char* end) {
  while (at != end && is_blank(*at)) ++at;
  return at;
}

// The end of `name` if it stands at `at`, in any case and spacing; else null.
const char* match(std::string_view name, const char* at, const char* end) {
  for (const char letter : name) {
    at = skip_blanks(at, end);
    if (at == end || to_upper(*at) != letter) return nullptr;
    ++at;
  }
  return at;
}

// Finds the operator at `at` and moves `at` to its end.
Operator find_operator(const char*& at, const char* end) {
  if (at == end) return {};
  switch (*at) {
    case '+': ++at; return plus;
    case '-': ++at; return minus;
    case '/': ++at; return divided_by;
    case '*': {
      const char* const second = skip_blanks(++at, end);
      if (second == end || *second != '*') return times;
      at = second + 1;
      return to_the_power;
    }
    default: break;
  }
  for (const Operator& word : word_operators) {
    if (const char* const after = match(word.name, at, end)) {
      at = after;
      return word;
    }
  }
  return {};
}

int effect_on_stack(ExpressionOp op) {
  switch (op) {
    case ExpressionOp::number:
    case ExpressionOp::named_parameter:
    case ExpressionOp::exists_named: return 1;
    case ExpressionOp::atan: return -1;
    default: return op >= ExpressionOp::power && op <= ExpressionOp::bit_xor ? -1 : 0;
  }
}

}  // namespace

bool LineParser::parse_expression(Expression& expression, const char* owner) {
  peek();
  const char* const start = at_;
  const std::size_t first = block_.code.size();
  operands_ = 0;
  if (!parse_value(owner)) return false;
  expression.first = static_cast<std::uint32_t>(first);
  expression.count = static_cast<std::uint32_t>(block_.code.size() - first);
  expression.span = span_from(start);
  return true;
}

bool LineParser::parse_value(const char* owner) {
  const char c = peek();
  if (is_digit(c) || c == '.') return parse_number(owner);
  if (nesting_ == deepest_expression && !at_end()) {
    return fail("gcode.expression-too-deep", at_, 1, "the expression is nested too deeply",
                "at most " + std::to_string(deepest_expression) + " levels; store a part of it in a parameter");
  }
  ++nesting_;
  bool good = false;
  switch (c) {
    case '+':
    case '-': good = parse_sign(owner); break;
    case '[': good = parse_brackets(); break;
    case '#': good = parse_parameter(); break;
    default: good = is_letter(c) ? parse_function(owner) : fail_missing_value(owner);
  }
  --nesting_;
  return good;
}

bool LineParser::parse_number(const char* owner) {
  const char* const start = at_;
  const NumberReading reading = read_number(at_, end_);
  if (reading.status == NumberStatus::no_digits) return fail_missing_value(owner);
  token_end_ = at_ = reading.end;
  if (reading.spaced && !block_.spaced_number) block_.spaced_number = span_from(start);
  if (reading.status == NumberStatus::good) return emit(ExpressionOp::number, start, reading.value);
  const bool too_long = reading.status == NumberStatus::too_long;
  return fail("gcode.number-out-of-range", start, span_from(start).length,
              too_long ? "the number has too many digits" : "the number is too large",
              too_long ? "at most " + std::to_string(longest_number) + " digits" : "a number below 1.8e308");
}

// A sign belongs to the number after it. Before anything else it is an operation. On a plain number the result is a
// number again.
bool LineParser::parse_sign(const char* owner) {
  const char* const start = at_;
  const char* const after = skip_blanks(at_ + 1, end_);
  if (after != end_ && (is_digit(*after) || *after == '.')) return parse_number(owner);
  const bool negative = *at_ == '-';
  consume();
  const std::size_t first = block_.code.size();
  if (!parse_value(start)) return false;
  if (!negative) return true;
  Instruction& operand = block_.code.back();
  if (block_.code.size() > first + 1 || operand.op != ExpressionOp::number) return emit(ExpressionOp::negate, start);
  operand.number = -operand.number;
  operand.span = span_from(start);
  return true;
}

bool LineParser::parse_brackets() {
  const char* const open = at_;
  consume();
  if (!parse_binary(lowest, open)) return false;
  if (peek() != ']') return fail_in_brackets(open);
  consume();
  return true;
}

// Precedence climbing: takes operators that bind at least as tight as `lowest_precedence`.
bool LineParser::parse_binary(int lowest_precedence, const char* owner) {
  peek();
  const char* const start = at_;
  if (!parse_value(owner)) return false;
  for (;;) {
    peek();
    const char* after = at_;
    const Operator found = find_operator(after, end_);
    if (found.precedence < lowest_precedence) return true;
    const char* const sign = at_;
    token_end_ = at_ = after;
    last_operator_ = {sign, after};
    if (!parse_binary(found.precedence + 1, sign)) return false;
    if (!emit(found.op, start)) return false;
  }
}

bool LineParser::parse_parameter() {
  const char* const start = at_;
  consume();
  if (peek() != '<') return parse_value(start) && emit(ExpressionOp::parameter, start);
  Symbol symbol;
  return parse_name(symbol) && emit(ExpressionOp::named_parameter, start, 0, symbol);
}

bool LineParser::parse_function(const char* owner) {
  const char* const start = at_;
  std::array<char, 8> letters;  // longer than the longest name
  const std::string_view name = read_letters(letters.data(), letters.size());
  for (const Function& function : functions) {
    if (function.name != name) continue;
    if (function.op == ExpressionOp::exists_parameter) return parse_exists(start);
    if (!parse_function_argument(start)) return false;
    if (function.op == ExpressionOp::atan) {
      if (peek() != '/') {
        return fail("gcode.unexpected-text", start, span_from(start).length, "ATAN has only one argument",
                    "two: ATAN[y]/[x]");
      }
      consume();
      if (!parse_function_argument(start)) return false;
    }
    return emit(function.op, start);
  }
  // No function has this name. If brackets follow, a function was meant; else a value is missing: "X Y5".
  while (is_letter(peek())) consume();
  const Span written = span_from(start);
  const char next = peek();
  if (written.length > 1 && (next == '[' || next == '(')) return fail_function(start, {start, written.length});
  at_ = start;
  return fail_missing_value(owner);
}

bool LineParser::parse_function_argument(const char* name_start) {
  if (peek() == '[') return parse_brackets();
  const std::string_view name(name_start, static_cast<std::size_t>(token_end_ - name_start));
  return fail("gcode.unexpected-text", name_start, name.size(), std::string(name) + " has no [ after it",
              "its argument in square brackets, e.g. SIN[30]");
}

bool LineParser::parse_exists(const char* name_start) {
  bool good = peek() == '[';
  if (good) {
    consume();
    good = peek() == '#';
  }
  if (!good) {
    return fail("gcode.unexpected-text", name_start, span_from(name_start).length,
                "the argument of EXISTS is not a parameter", "EXISTS[#<name>] or EXISTS[#5]");
  }
  const char* const hash = at_;
  consume();
  Symbol symbol;
  ExpressionOp op = ExpressionOp::exists_parameter;
  if (peek() == '<') {
    op = ExpressionOp::exists_named;
    if (!parse_name(symbol)) return false;
  } else if (!parse_value(hash)) {
    return false;
  }
  if (peek() != ']') {
    return fail("gcode.unexpected-text", name_start, span_from(name_start).length,
                "the argument of EXISTS is more than a parameter", "']' after the parameter, e.g. EXISTS[#<name>]");
  }
  consume();
  return emit(op, name_start, 0, symbol);
}

bool LineParser::parse_name(Symbol& symbol) {
  const char* const open = at_;
  consume();
  const char* const first = at_;
  bool any = false;
  for (; at_ != end_ && *at_ != '>'; ++at_) {
    const auto byte = static_cast<unsigned char>(*at_);
    const bool is_control = (byte < 0x20 && *at_ != '\t') || byte == 0x7F;
    if (is_control || *at_ == '<' || *at_ == '(' || *at_ == ')' || *at_ == ';') {
      return fail("gcode.bad-parameter-name", at_, 1, name_character(rest(at_)).name + " cannot be part of a name",
                  "letters, digits and '_', then '>'");
    }
    any = any || !is_blank(*at_);
  }
  if (at_end()) {
    return fail("gcode.bad-parameter-name", open, 1, "the name that starts here is not closed", "'>' after the name");
  }
  if (!any) return fail("gcode.bad-parameter-name", open, 2, "the name is empty", "a name between '<' and '>'");
  symbol = symbols_.intern({first, static_cast<std::size_t>(at_ - first)});
  consume();
  return true;
}

bool LineParser::emit(ExpressionOp op, const char* start, double number, Symbol symbol) {
  operands_ += static_cast<std::size_t>(effect_on_stack(op));
  if (operands_ > deepest_expression) {
    return fail("gcode.expression-too-deep", start, span_from(start).length, "the expression is too complex",
                "at most " + std::to_string(deepest_expression) + "; store a part of it in a parameter");
  }
  block_.code.push_back({op, span_from(start), number, symbol});
  return true;
}

}  // namespace passo
