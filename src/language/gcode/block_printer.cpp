// print: a block in its canonical spelling. Upper case, one blank between items, words before comments.
#include <cassert>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "number.hpp"
#include <fmt/format.h>

#include "passo/gcode/block_parser.hpp"

namespace passo {
namespace {

// How an instruction is written. A higher precedence binds tighter; 0 means a function.
struct Spelling {
  const char* name = "";
  int precedence = 0;
};

constexpr int tightest = 9;  // a value that needs no brackets

Spelling spelling_of(ExpressionOp op) {
  switch (op) {
    case ExpressionOp::bit_and: return {" AND ", 1};
    case ExpressionOp::bit_or: return {" OR ", 1};
    case ExpressionOp::bit_xor: return {" XOR ", 1};
    case ExpressionOp::equal: return {" EQ ", 2};
    case ExpressionOp::not_equal: return {" NE ", 2};
    case ExpressionOp::greater: return {" GT ", 2};
    case ExpressionOp::greater_equal: return {" GE ", 2};
    case ExpressionOp::less: return {" LT ", 2};
    case ExpressionOp::less_equal: return {" LE ", 2};
    case ExpressionOp::add: return {" + ", 3};
    case ExpressionOp::subtract: return {" - ", 3};
    case ExpressionOp::multiply: return {" * ", 4};
    case ExpressionOp::divide: return {" / ", 4};
    case ExpressionOp::modulo: return {" MOD ", 4};
    case ExpressionOp::power: return {" ** ", 5};
    case ExpressionOp::abs: return {"ABS"};
    case ExpressionOp::acos: return {"ACOS"};
    case ExpressionOp::asin: return {"ASIN"};
    case ExpressionOp::cos: return {"COS"};
    case ExpressionOp::exp: return {"EXP"};
    case ExpressionOp::fix: return {"FIX"};
    case ExpressionOp::fup: return {"FUP"};
    case ExpressionOp::ln: return {"LN"};
    case ExpressionOp::round: return {"ROUND"};
    case ExpressionOp::sin: return {"SIN"};
    case ExpressionOp::sqrt: return {"SQRT"};
    case ExpressionOp::tan: return {"TAN"};
    default: break;  // ExpressionPrinter writes it itself
  }
  return {};
}

// Runs the postfix code on texts instead of numbers.
class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(const SymbolTable& symbols) : symbols_(symbols) {}

  // Prints the expression as a value: a number, a parameter, a function or brackets.
  std::string print(const Block& block, const Expression& expression) {
    for (std::uint32_t i = 0; i < expression.count; ++i) add(block.code[expression.first + i]);
    return pop_value();
  }

  // Prints the expression in brackets, always.
  std::string print_bracketed(const Block& block, const Expression& expression) {
    for (std::uint32_t i = 0; i < expression.count; ++i) add(block.code[expression.first + i]);
    return fmt::format("[{}]", pop().text);
  }

 private:
  struct Operand {
    std::string text;
    int precedence = tightest;
  };

  void add(const Instruction& instruction) {
    switch (instruction.op) {
      case ExpressionOp::number: return push(format_number(instruction.number));
      case ExpressionOp::parameter: return push("#" + pop_value());
      case ExpressionOp::named_parameter: return push(fmt::format("#<{}>", symbols_.name(instruction.symbol)));
      case ExpressionOp::exists_parameter: return push(fmt::format("EXISTS[#{}]", pop_value()));
      case ExpressionOp::exists_named: return push(fmt::format("EXISTS[#<{}>]", symbols_.name(instruction.symbol)));
      case ExpressionOp::negate: return push("-" + pop_value());
      case ExpressionOp::atan: {
        const std::string x = pop().text;
        return push(fmt::format("ATAN[{}]/[{}]", pop().text, x));
      }
      default: break;
    }
    const Spelling spelling = spelling_of(instruction.op);
    if (spelling.precedence == 0) return push(fmt::format("{}[{}]", spelling.name, pop().text));
    const std::string right = pop_value(spelling.precedence + 1);
    const std::string left = pop_value(spelling.precedence);
    stack_.push_back({left + spelling.name + right, spelling.precedence});
  }

  void push(std::string text) { stack_.push_back({std::move(text), tightest}); }
  Operand pop() {
    assert(!stack_.empty());
    Operand operand = std::move(stack_.back());
    stack_.pop_back();
    return operand;
  }
  // Adds brackets if the value binds looser than `least`.
  std::string pop_value(int least = tightest) {
    Operand operand = pop();
    return operand.precedence < least ? fmt::format("[{}]", operand.text) : std::move(operand.text);
  }

  const SymbolTable& symbols_;
  std::vector<Operand> stack_;
};

const char* keyword_of(BlockComment::Kind kind) {
  switch (kind) {
    case BlockComment::Kind::plain: return "";
    case BlockComment::Kind::message: return "MSG";
    case BlockComment::Kind::debug: return "DEBUG";
    case BlockComment::Kind::print: return "PRINT";
    case BlockComment::Kind::log: return "LOG";
    case BlockComment::Kind::log_open: return "LOGOPEN";
    case BlockComment::Kind::log_append: return "LOGAPPEND";
    case BlockComment::Kind::log_close: return "LOGCLOSE";
    case BlockComment::Kind::abort: return "ABORT";
    case BlockComment::Kind::probe_open: return "PROBEOPEN";
    case BlockComment::Kind::probe_close: return "PROBECLOSE";
  }
  return "";
}

const char* keyword_of(ControlKind kind) {
  switch (kind) {
    case ControlKind::sub: return "SUB";
    case ControlKind::endsub: return "ENDSUB";
    case ControlKind::call: return "CALL";
    case ControlKind::return_: return "RETURN";
    case ControlKind::do_: return "DO";
    case ControlKind::while_: return "WHILE";
    case ControlKind::endwhile: return "ENDWHILE";
    case ControlKind::if_: return "IF";
    case ControlKind::elseif: return "ELSEIF";
    case ControlKind::else_: return "ELSE";
    case ControlKind::endif: return "ENDIF";
    case ControlKind::repeat: return "REPEAT";
    case ControlKind::endrepeat: return "ENDREPEAT";
    case ControlKind::break_: return "BREAK";
    case ControlKind::continue_: return "CONTINUE";
    case ControlKind::program: return "";
  }
  return "";
}

// The last plain comment is written after ';', where any text may stand. The others keep their brackets.
std::string print_comment(const BlockComment& comment, bool is_last) {
  if (comment.kind == BlockComment::Kind::plain) {
    return is_last ? fmt::format(";{}", comment.text) : fmt::format("({})", comment.text);
  }
  // These three are written without a comma: a blank, then the text.
  const bool bare = comment.kind == BlockComment::Kind::log_close || comment.kind == BlockComment::Kind::probe_open ||
                    comment.kind == BlockComment::Kind::probe_close;
  const bool comma = !bare || !(comment.text.empty() || comment.text.front() == ' ' || comment.text.front() == '\t');
  return fmt::format("({}{}{})", keyword_of(comment.kind), comma ? "," : "", comment.text);
}

std::string print_label(const Block& block, const Control& control, ExpressionPrinter& expressions,
                        const SymbolTable& symbols) {
  if (control.computed_label) return expressions.print_bracketed(block, *control.computed_label);
  const std::string_view name = symbols.name(control.label);
  const bool is_number = !name.empty() && name.find_first_not_of("0123456789") == std::string_view::npos;
  return is_number && name.size() < 9 && (name == "0" || name[0] != '0') ? std::string(name)
                                                                         : fmt::format("<{}>", name);
}

}  // namespace

std::string print(const Block& block, const SymbolTable& symbols) {
  if (block.percent) return "%";
  ExpressionPrinter expressions(symbols);
  std::string out;
  const auto item = [&out](std::string_view text) {
    if (!out.empty() && out != "/") out += ' ';
    out += text;
  };
  if (block.block_delete) out = "/";
  if (block.line_number) item(fmt::format("N{}", *block.line_number));
  if (block.control) {
    const Control& control = *block.control;
    item("O" + print_label(block, control, expressions, symbols));
    if (control.kind != ControlKind::program) item(keyword_of(control.kind));
    for (const Expression& argument : control.arguments) item(expressions.print_bracketed(block, argument));
  }
  for (const Word& word : block.words) item(fmt::format("{}{}", word.letter, expressions.print(block, word.value)));
  for (const Assignment& assignment : block.assignments) {
    const std::string target = assignment.index ? expressions.print(block, *assignment.index)
                                                : fmt::format("<{}>", symbols.name(assignment.symbol));
    item(fmt::format("#{}={}", target, expressions.print(block, assignment.value)));
  }
  for (const BlockComment& comment : block.comments) item(print_comment(comment, &comment == &block.comments.back()));
  return out;
}

}  // namespace passo
