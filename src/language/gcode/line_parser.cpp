#include "line_parser.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "gcode_sentences.hpp"

#include "passo/gcode/expression.hpp"
#include "passo/gcode/grbl_command.hpp"

namespace passo {
namespace {

struct CommentKeyword {
  std::string_view name;
  BlockComment::Kind kind;
  bool takes_comma;  // LinuxCNC writes (LOGCLOSE) and (PROBEOPEN name) without a comma
};

constexpr std::array comment_keywords = {
    CommentKeyword{"MSG", BlockComment::Kind::message, true},
    CommentKeyword{"DEBUG", BlockComment::Kind::debug, true},
    CommentKeyword{"PRINT", BlockComment::Kind::print, true},
    CommentKeyword{"LOG", BlockComment::Kind::log, true},
    CommentKeyword{"LOGOPEN", BlockComment::Kind::log_open, true},
    CommentKeyword{"LOGAPPEND", BlockComment::Kind::log_append, true},
    CommentKeyword{"LOGCLOSE", BlockComment::Kind::log_close, false},
    CommentKeyword{"ABORT", BlockComment::Kind::abort, true},
    CommentKeyword{"PROBEOPEN", BlockComment::Kind::probe_open, false},
    CommentKeyword{"PROBECLOSE", BlockComment::Kind::probe_close, false},
};

const CommentKeyword* find_comment_keyword(std::string_view name) {
  for (const CommentKeyword& keyword : comment_keywords) {
    if (keyword.name == name) return &keyword;
  }
  return nullptr;
}

// Finds the keyword at the start of a comment and removes it from the text.
BlockComment::Kind take_keyword(std::string_view& text) {
  std::array<char, 10> letters;  // the longest keyword
  std::size_t size = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = to_upper(text[i]);
    if (is_blank(c)) continue;
    if (c != ',') {
      if (!is_letter(c) || size == letters.size()) break;
      letters[size++] = c;
      const bool word_goes_on = i + 1 < text.size() && !is_blank(text[i + 1]);
      if (word_goes_on) continue;
    }
    const CommentKeyword* const keyword = find_comment_keyword({letters.data(), size});
    if (keyword != nullptr && (c == ',' || !keyword->takes_comma)) {
      text.remove_prefix(i + 1);
      return keyword->kind;
    }
    if (c == ',') break;
  }
  return BlockComment::Kind::plain;
}

struct ControlKeyword {
  std::string_view name;
  ControlKind kind;
};

constexpr std::array control_keywords = {
    ControlKeyword{"SUB", ControlKind::sub},
    ControlKeyword{"ENDSUB", ControlKind::endsub},
    ControlKeyword{"CALL", ControlKind::call},
    ControlKeyword{"RETURN", ControlKind::return_},
    ControlKeyword{"DO", ControlKind::do_},
    ControlKeyword{"WHILE", ControlKind::while_},
    ControlKeyword{"ENDWHILE", ControlKind::endwhile},
    ControlKeyword{"IF", ControlKind::if_},
    ControlKeyword{"ELSEIF", ControlKind::elseif},
    ControlKeyword{"ELSE", ControlKind::else_},
    ControlKeyword{"ENDIF", ControlKind::endif},
    ControlKeyword{"REPEAT", ControlKind::repeat},
    ControlKeyword{"ENDREPEAT", ControlKind::endrepeat},
    ControlKeyword{"BREAK", ControlKind::break_},
    ControlKeyword{"CONTINUE", ControlKind::continue_},
};

constexpr std::size_t any_number = ~std::size_t{0};

struct ArgumentCount {
  std::size_t least;
  std::size_t most;
};

ArgumentCount arguments_of(ControlKind kind) {
  switch (kind) {
    case ControlKind::call: return {0, any_number};
    case ControlKind::return_:
    case ControlKind::endsub: return {0, 1};
    case ControlKind::while_:
    case ControlKind::if_:
    case ControlKind::elseif:
    case ControlKind::repeat: return {1, 1};
    default: return {0, 0};
  }
}

}  // namespace

bool LineParser::parse() {
  char c = peek();
  if (c == '$') {
    if (std::optional<GrblCommand> command = grbl_command_in(rest(at_))) {
      return fail("gcode.grbl-command", at_, rest(at_).size(), std::move(command->message),
                  std::move(command->expected));
    }
  }
  if (c == '%') {
    consume();
    block_.percent = true;
    peek();
    return at_end() || fail_unexpected();
  }
  if (c == '/') {
    consume();
    block_.block_delete = true;
    c = peek();
  }
  if (c == 'N') {
    if (!parse_line_number()) return false;
    c = peek();
  }
  return c == 'O' ? parse_control() : parse_items();
}

bool LineParser::parse_items() {
  for (;;) {
    const char c = peek();
    switch (c) {
      case '\0':
        if (at_end()) return true;
        return fail_unexpected();
      case '#':
        if (!parse_assignment()) return false;
        break;
      case '(':
        if (!parse_comment()) return false;
        break;
      case ';': parse_semicolon_comment(); return true;
      case 'N':
        if (!line_numbers_anywhere_) return fail_unexpected();
        if (!parse_line_number()) return false;
        break;
      case 'O': return fail_unexpected();
      default:
        if (!is_letter(c) && c != '@' && c != '^' && c != '$') return fail_unexpected();
        if (const char* const start = at_; !parse_word(c)) return fail_foreign_word(start);
    }
  }
}

// In grbl N is a word like others: with a sign, anywhere, and once.
bool LineParser::parse_line_number() {
  const char* const n = at_;
  const bool as_word = line_numbers_anywhere_;
  if (as_word && block_.line_number) {
    return fail("gcode.repeated-word", n, 1, gcode_says::second_line_number.with({{"letter", "N"}}),
                "each letter once");
  }
  consume();
  const bool is_negative = as_word && peek() == '-';
  if (is_negative || (as_word && peek() == '+')) consume();
  bool point = false;
  bool any_digit = false;
  const char* first = nullptr;
  for (char c = peek(); is_digit(c) || (c == '.' && !point && (any_digit || as_word)); c = peek()) {
    if (first == nullptr) first = at_;
    point = point || c == '.';
    any_digit = any_digit || is_digit(c);
    consume();
  }
  if (!any_digit) {
    return fail("gcode.missing-value", n, 1, "N has no line number", "digits after N, e.g. N120");
  }
  if (is_negative) return fail("gcode.negative-word", n, 1, "the line number is negative", "N of 0 or more");
  block_.line_number = std::string_view(first, static_cast<std::size_t>(token_end_ - first));
  return true;
}

bool LineParser::parse_word(char letter) {
  const char* const start = at_;
  consume();
  Word& word = block_.words.emplace_back();
  word.letter = letter;
  if (!parse_expression(word.value, start)) return false;
  word.span = span_from(start);
  return true;
}

bool LineParser::parse_assignment() {
  const char* const start = at_;
  consume();
  Assignment& assignment = block_.assignments.emplace_back();
  if (peek() == '<') {
    if (!parse_name(assignment.symbol)) return false;
  } else if (!parse_expression(assignment.index.emplace(), start)) {
    return false;
  }
  if (peek() != '=') return fail_assignment(start);
  const char* const equals = at_;
  consume();
  if (!parse_expression(assignment.value, equals)) return false;
  assignment.span = span_from(start);
  return true;
}

bool LineParser::parse_comment() {
  const char* const open = at_;
  const char* close = open + 1;
  while (close != end_ && *close != ')' && *close != '(') ++close;
  if (close == end_) {
    return fail("gcode.unclosed-comment", open, 1, gcode_says::comment_open, gcode_says::close_on_line);
  }
  if (*close == '(') {
    return fail("gcode.nested-comment", close, 1, gcode_says::comment_in_comment,
                "no '(' before the ')' that closes the comment");
  }
  BlockComment& comment = block_.comments.emplace_back();
  comment.text = std::string_view(open + 1, static_cast<std::size_t>(close - open - 1));
  comment.kind = take_keyword(comment.text);
  at_ = close;
  consume();
  comment.span = span_from(open);
  return true;
}

// A comment from ';' to the end of the line. As in LinuxCNC, its text never acts as a command.
void LineParser::parse_semicolon_comment() {
  const char* const start = at_;
  token_end_ = at_ = end_;
  BlockComment& comment = block_.comments.emplace_back();
  comment.text = rest(start).substr(1);
  comment.span = span_from(start);
}

bool LineParser::parse_control() {
  const char* const start = at_;
  consume();
  Control& control = block_.control.emplace();
  control.arguments.swap(block_.spare);
  if (!parse_label(control)) return false;

  const char next = peek();
  if (at_end() || next == '(' || next == ';') {
    control.kind = ControlKind::program;
    control.span = span_from(start);
    return parse_comments_only();
  }
  const char* const keyword_start = at_;
  std::array<char, 12> letters;  // longer than the longest keyword
  const std::string_view name = read_letters(letters.data(), letters.size());
  for (const ControlKeyword& keyword : control_keywords) {
    if (keyword.name != name) continue;
    control.kind = keyword.kind;
    if (!parse_control_arguments(control, keyword_start)) return false;
    control.span = span_from(start);
    return parse_comments_only();
  }
  return fail_control_keyword(keyword_start, name);
}

bool LineParser::parse_label(Control& control) {
  const char* const o = token_end_ - 1;
  const char c = peek();
  if (c == '<') return parse_name(control.label);
  const char* const first = at_;
  if (!is_digit(c) && c != '#' && c != '[' && c != '-' && c != '+') {
    return fail("gcode.bad-o-word", o, 1, "the O-word has no label", "a number, <name> or [expression] after O");
  }
  Expression label;
  if (!parse_expression(label, o)) return false;
  const Instruction& instruction = block_.code[label.first];
  if (label.count > 1 || instruction.op != ExpressionOp::number) {
    control.computed_label = label;
    return true;
  }
  // A label that is a plain number is treated as a name: "o100" is "o<100>".
  const double number = std::round(instruction.number);
  if (std::abs(number - instruction.number) > whole_number_tolerance || std::abs(number) > 1e9) {
    return fail("gcode.bad-o-word", first, label.span.length, "the label of the O-word is not a whole number",
                "a whole number, e.g. O100, or a name, e.g. O<drill>");
  }
  block_.code.resize(label.first);
  control.label = symbols_.intern(std::to_string(static_cast<long long>(number)));
  return true;
}

bool LineParser::parse_control_arguments(Control& control, const char* keyword) {
  const ArgumentCount count = arguments_of(control.kind);
  const Span name = span_from(keyword);
  while (control.arguments.size() < count.most) {
    const char c = peek();
    if (c == '(' && control.kind == ControlKind::call) {  // LinuxCNC allows comments between arguments
      const char* const argument_end = token_end_;
      if (!parse_comment()) return false;
      token_end_ = argument_end;
      continue;
    }
    if (c != '[') break;
    Expression& argument = control.arguments.emplace_back();
    if (!parse_expression(argument, at_)) return false;
  }
  if (control.arguments.size() < count.least) {
    return fail("gcode.missing-value", keyword, name.length, std::string(keyword, name.length) + " has no condition",
                "[expression] after it");
  }
  return true;
}

bool LineParser::parse_comments_only() {
  for (;;) {
    const char c = peek();
    if (at_end()) return true;
    if (c == ';') {
      parse_semicolon_comment();
      return true;
    }
    if (c != '(') return fail_unexpected();
    if (!parse_comment()) return false;
  }
}

std::string_view LineParser::read_letters(char* buffer, std::size_t size) {
  std::size_t count = 0;
  while (count < size && is_letter(peek())) {
    buffer[count++] = to_upper(*at_);
    consume();
  }
  return {buffer, count};
}

}  // namespace passo
