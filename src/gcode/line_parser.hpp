// LineParser: the grammar of one line of RS274/NGC, by recursive descent.
//
//   line       = [ '/' ] [ N digits ] ( control | { word | assignment | comment } )   or '%' alone
//   word       = letter value
//   assignment = '#' ( '<' name '>' | value ) '=' value
//   control    = O label keyword { '[' expression ']' }
//   value      = [ sign ] number | sign value | '[' expression ']' | '#' ( '<' name '>' | value )
//              | function '[' expression ']' | ATAN '[' expression ']' '/' '[' expression ']' | EXISTS '[' '#' … ']'
//   expression = value { operator value }                                             by precedence, from the left
//
// Blanks mean nothing outside comments, and so every token may have blanks inside. Expressions go to Block::code in
// postfix order as they are read. The first fault ends the line. Lives on the stack for one line; depth is bounded.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "characters.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

// What is wrong with a line; its place in bytes from the line's start.
struct LineFault {
  const char* code = "";
  std::size_t offset = 0;
  std::size_t length = 1;
  std::string message;
  std::string expected;
};

class LineParser {
 public:
  // `block` is clear; its views will point into `text`.
  LineParser(std::string_view text, Block& block, SymbolTable& symbols, LineFault& fault)
      : begin_(text.data()),
        end_(text.data() + text.size()),
        at_(begin_),
        token_end_(begin_),
        block_(block),
        symbols_(symbols),
        fault_(fault) {}

  // False: see the fault.
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

  // value_parser.cpp: what gives a number. Each adds to Block::code; `owner` is what has no value if there is none.
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

  // line_fault.cpp: the wording of what is wrong. All return false.
  bool fail(const char* code, const char* from, std::size_t length, std::string message, std::string expected);
  bool fail_missing_value(const char* owner);
  bool fail_unexpected();                   // at_ is where no item can start
  bool fail_in_brackets(const char* open);  // at_ is where an operator or ']' should be
  bool fail_function(const char* name_start, std::string_view name);
  bool fail_assignment(const char* target);  // no '=' after the parameter
  bool fail_letter_o(const char* o);         // an O that is not the first on its line, perhaps a zero
  bool fail_control_keyword(const char* start, std::string_view keyword);

  bool at_end() const { return at_ == end_; }
  // The next character that is not blank, in upper case; NUL at the end.
  char peek() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
    return at_ == end_ ? '\0' : to_upper(*at_);
  }
  void take() { token_end_ = ++at_; }
  // The letters that come next, blanks left out, in upper case, as far as `buffer` goes; takes them.
  std::string_view take_letters(char* buffer, std::size_t size);
  Span span_from(const char* start) const {
    return {static_cast<std::uint32_t>(start - begin_ + 1), static_cast<std::uint32_t>(token_end_ - start)};
  }
  std::string_view rest(const char* from) const { return {from, static_cast<std::size_t>(end_ - from)}; }

  const char* const begin_;
  const char* const end_;
  const char* at_;
  const char* token_end_;  // after the last character that was taken: blanks at a span's end do not count
  Block& block_;
  SymbolTable& symbols_;
  LineFault& fault_;
  std::size_t nesting_ = 0;   // values inside values
  std::size_t operands_ = 0;  // on the stack when the expression will be evaluated
};

}  // namespace passo
