// Block: one parsed line of G-code, before its interpretation.
//
// The parser handles the syntax of RS274/NGC: words, expressions, parameters, comments, O-words. Their meaning
// (letters, modal groups, numbers) is left to the interpreter. A Block does not own the text of its line: its views
// point into the reader's buffer and are valid until the next line is read. It keeps the capacity of its vectors, so
// that after the first few lines, parsing allocates no memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "passo/gcode/symbols.hpp"

namespace passo {

// A part of the line. The column counts from 1, in bytes.
struct Span {
  std::uint32_t column = 0;
  std::uint32_t length = 0;
  friend bool operator==(const Span&, const Span&) = default;
};

// The effect of one instruction of an expression on the stack of numbers.
enum class ExpressionOp : std::uint8_t {
  number,            // push `number`
  parameter,         // pop n, push #n
  named_parameter,   // push the parameter named `symbol`
  exists_parameter,  // pop n, push whether #n exists
  exists_named,      // push whether the parameter named `symbol` exists
  negate,
  // two operands
  power,
  multiply,
  divide,
  modulo,
  add,
  subtract,
  equal,
  not_equal,
  greater,
  greater_equal,
  less,
  less_equal,
  bit_and,
  bit_or,
  bit_xor,
  // functions; angles in degrees; atan takes two: ATAN[y]/[x]
  abs,
  acos,
  asin,
  atan,
  cos,
  exp,
  fix,
  fup,
  ln,
  round,
  sin,
  sqrt,
  tan,
};

struct Instruction {
  ExpressionOp op = ExpressionOp::number;
  Span span;  // the part of the line that is marked if the value cannot be computed
  double number = 0;
  Symbol symbol{};
};

// A slice of Block::code in postfix order. Most expressions are one `number`.
struct Expression {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Span span;
};

struct Word {
  char letter = 0;  // upper case A…Z, '@', '^' or '$'
  Expression value;
  Span span;  // letter and value
};

// #12 = …, #<name> = …
struct Assignment {
  std::optional<Expression> index;  // #[…]: the number of the parameter; empty: `symbol` names it
  Symbol symbol{};
  Expression value;
  Span span;
};

struct BlockComment {
  enum class Kind : std::uint8_t {
    plain,
    message,
    debug,
    print,
    log,
    log_open,
    log_append,
    log_close,
    abort,
    probe_open,
    probe_close
  };
  Kind kind = Kind::plain;
  std::string_view text;  // text of the comment as written, without the delimiters and without a keyword such as "MSG,"
  Span span;
};

enum class ControlKind : std::uint8_t {
  sub,
  endsub,
  call,
  return_,
  do_,
  while_,
  endwhile,
  if_,
  elseif,
  else_,
  endif,
  repeat,
  endrepeat,
  break_,
  continue_,
  program,  // only the label ("O2000"): the start of a Fanuc-style program that M98 calls
};

// An O… line: flow of control.
struct Control {
  ControlKind kind = ControlKind::sub;
  // The label is a name, a plain number ("o100" and "o<100>" are the same label) or a computed number.
  Symbol label{};
  std::optional<Expression> computed_label;
  std::vector<Expression> arguments;  // call: any number; if, elseif, while, repeat: one; return, endsub: at most one
  Span span;
};

struct Block {
  std::uint32_t line = 0;                       // line number in its file, from 1
  std::string_view text;                        // the line without its line end
  bool block_delete = false;                    // starts with '/'
  bool percent = false;                         // a line with only '%'
  std::optional<std::string_view> line_number;  // the digits after N, as written
  std::vector<Word> words;                      // in order, without N
  std::vector<Assignment> assignments;
  std::vector<BlockComment> comments;
  std::optional<Control> control;
  std::optional<Span> spaced_number;  // the first number with spaces between its digits, e.g. "X20 5"
  std::vector<Instruction> code;      // all expressions above are slices of it
  std::vector<Expression> spare;      // keeps the capacity of control->arguments for later blocks with a control

  bool empty() const { return words.empty() && assignments.empty() && comments.empty() && !control && !percent; }
  // Empties the block and keeps the capacity of its vectors.
  void clear();
};

}  // namespace passo
