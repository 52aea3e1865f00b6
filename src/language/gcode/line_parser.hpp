// LineParser: parses one line of RS274/NGC by recursive descent.
//
//   line       = [ '/' ] [ N digits ] ( control | { word | assignment | comment } )   or '%' alone
//   word       = letter value
//   assignment = '#' ( '<' name '>' | value ) '=' value
//   control    = O label keyword { '[' expression ']' }
//   value      = [ sign ] number | sign value | '[' expression ']' | '#' ( '<' name '>' | value )
//              | function '[' expression ']' | ATAN '[' expression ']' '/' '[' expression ']' | EXISTS '[' '#' … ']'
//   expression = value { operator value }                                             by precedence, from the left
//
// Blanks are ignored outside comments, so every token may contain blanks. Expressions are stored in Block::code in
// postfix order while they are read. The first error ends the line. A LineParser lives on the stack for one line, and
// its recursion depth is bounded.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "characters.hpp"

#include "passo/diagnostics/finding_words.hpp"
#include "passo/gcode/block.hpp"

namespace passo {

// An error in a line. The position is a byte offset from the start of the line.
struct LineFault {
  const char* code = "";
  std::size_t offset = 0;
  std::size_t length = 1;
  FindingWords message;
  FindingWords expected;
};

class LineParser {
 public:
  // `block` must be empty. Its views will point into `text`.
  LineParser(std::string_view text, Block& block, SymbolTable& symbols, LineFault& fault,
             bool line_numbers_anywhere = false)
      : begin_(text.data()),
        end_(text.data() + text.size()),
        at_(begin_),
        token_end_(begin_),
        block_(block),
        symbols_(symbols),
        fault_(fault),
        line_numbers_anywhere_(line_numbers_anywhere) {}

  // Returns false after an error, which is described in `fault`.
  bool parse();

 private:
  // line_parser.cpp: the items of a line.
  bool parse_items();
  bool parse_line_number();
  bool parse_word(char letter);
  bool parse_assignment();
  bool parse_comment();
  void parse_semicolon_comment();
  bool parse_control();
  bool parse_label(Control& control);
  bool parse_control_arguments(Control& control, const char* keyword);
  bool parse_comments_only();

  // line_parser_values.cpp: everything that yields a number. Each function appends to Block::code. `owner`: what the
  // value belongs to, for the error message if it is missing.
  bool parse_expression(Expression& expression, const char* owner);
  bool parse_value(const char* owner);
  bool parse_number(const char* owner);
  bool parse_sign(const char* owner);
  bool parse_brackets();
  bool parse_binary(int lowest_precedence, const char* owner);
  bool parse_parameter();
  bool parse_function(const char* owner);
  bool parse_function_argument(const char* name_start);
  bool parse_exists(const char* name_start);
  bool parse_name(Symbol& symbol);
  bool emit(ExpressionOp op, const char* start, double number = 0, Symbol symbol = {});

  // line_parser_faults.cpp: the messages. All return false.
  bool fail(const char* code, const char* from, std::size_t length, FindingWords message, FindingWords expected);
  bool fail_missing_value(const char* owner);
  bool is_digit_alike() const;
  bool fail_unexpected();                     // at_ is where no item can start
  bool fail_in_brackets(const char* open);    // at_ is where an operator or ']' is required
  bool fail_foreign_word(const char* start);  // an invalid word, possibly of a Fanuc macro
  bool fail_function(const char* name_start, std::string_view name);
  bool fail_assignment(const char* target);  // '=' is missing after the parameter
  bool fail_letter_o(const char* o);         // an O that is not the first item of its line; possibly a zero is meant
  bool fail_control_keyword(const char* start, std::string_view keyword);

  bool at_end() const { return at_ == end_; }
  // Returns the next non-blank character in upper case. NUL at the end.
  char peek() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    return at_ == end_ ? '\0' : to_upper(*at_);
  }
  void consume() { token_end_ = ++at_; }
  // Reads the following letters in upper case, without blanks, as far as `buffer` has room.
  std::string_view read_letters(char* buffer, std::size_t size);
  Span span_from(const char* start) const {
    return {static_cast<std::uint32_t>(start - begin_ + 1), static_cast<std::uint32_t>(token_end_ - start)};
  }
  std::string_view rest(const char* from) const { return {from, static_cast<std::size_t>(end_ - from)}; }

  const char* const begin_;
  const char* const end_;
  const char* at_;
  const char* token_end_;  // after the last character read; a span excludes trailing blanks
  Block& block_;
  SymbolTable& symbols_;
  LineFault& fault_;
  const bool line_numbers_anywhere_;
  std::size_t nesting_ = 0;         // current nesting depth of values
  std::size_t operands_ = 0;        // current operand stack size of the evaluation
  std::string_view last_operator_;  // the last operator, as written
};

}  // namespace passo
