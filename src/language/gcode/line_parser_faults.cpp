// LineParser's messages about a wrong line: what was found, what was expected, and a correction where one can be
// guessed.
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "gcode_sentences.hpp"
#include "line_parser.hpp"
#include <fmt/format.h>

#include "passo/base/utf8.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {
namespace {

constexpr const char* a_value = "a number, #parameter, [expression] or function";

// A message repeats at most this much of the line.
std::string shortened(std::string_view text) {
  constexpr std::size_t most = 24;
  if (text.size() <= most) return std::string(text);
  return std::string(cut_at_character(text, most)) + "...";
}

// Guesses the word that was meant: one with a wrong letter, or with two letters swapped.
std::string_view guess(std::string_view word, const std::vector<std::string_view>& candidates) {
  const std::string_view near = nearest(word, candidates);
  if (!near.empty()) return near;
  for (const std::string_view candidate : candidates) {
    if (std::ranges::is_permutation(word, candidate)) return candidate;
  }
  return {};
}

}  // namespace

bool LineParser::fail(const char* code, const char* from, std::size_t length, FindingWords message,
                      FindingWords expected) {
  fault_ = {code, static_cast<std::size_t>(from - begin_), length, std::move(message), std::move(expected)};
  return false;
}

// An l or an I right after a letter, and no value after it, is a 1 that was typed wrong.
bool LineParser::is_digit_alike() const {
  if (at_end() || at_ == begin_ || !is_letter(at_[-1])) return false;
  const char c = to_upper(*at_);
  if (c != 'L' && c != 'I') return false;
  const char* next = at_ + 1;
  while (next != end_ && is_blank(*next)) ++next;
  return next == end_ || (!is_digit(*next) && std::string_view(".+-[#").find(*next) == std::string_view::npos);
}

bool LineParser::fail_missing_value(const char* owner) {
  const char c = peek();
  const bool is_operator = owner == last_operator_.data();
  const std::string_view name = is_operator ? last_operator_ : std::string_view(owner, 1);
  const FindingWords whose = *owner == '[' ? FindingWords("the bracket is empty")
                             : is_operator ? FindingWords(fmt::format("'{}' has no value after it", name))
                                           : gcode_says::no_value.with({{"what", fmt::format("'{}'", name)}});
  if (at_end() || is_letter(c) || c == '(' || c == ';' || c == ']' || c == '#' || c == '[') {
    if (c == 'O') return fail_letter_o(at_);
    if (is_digit_alike()) {
      return fail("gcode.missing-value", at_, 1,
                  gcode_says::not_a_value.with({{"what", fmt::format("the letter '{}'", *at_)}}), "the digit 1");
    }
    const char* expected = a_value;
    if (c == '(') expected = "square brackets: '(' starts a comment";
    if (*owner == '#') expected = "a number or <name> for the parameter; a comment starts with ';'";
    return fail("gcode.missing-value", owner, name.size(), whose, expected);
  }
  const NamedCharacter found = name_character(rest(at_));
  FindingWords cure = found.cure.empty() ? std::string(a_value) : found.cure;
  if (c == ',') cure = gcode_says::decimal_point;
  if (c == '=') cure = "the value right after the letter, e.g. X5";
  const bool is_known = std::string_view("=+-*/.%)").find(c) != std::string_view::npos;  // has a meaning elsewhere
  return fail(is_known ? "gcode.missing-value" : "gcode.bad-character", at_, found.length,
              gcode_says::not_a_value.with({{"what", found.name}}), std::move(cure));
}

bool LineParser::fail_unexpected() {
  const char c = peek();
  const NamedCharacter found = name_character(rest(at_));
  if (block_.percent) {
    return fail("gcode.unexpected-text", at_, found.length, fmt::format("{} after '%'", found.name),
                "'%' alone on its line");
  }
  const char before = token_end_ == begin_ ? '\0' : token_end_[-1];
  const bool after_number = is_digit(before) || before == '.';
  if (block_.control) {
    return fail("gcode.unexpected-text", at_, found.length, fmt::format("{} after an O-word", found.name),
                "a comment or the end of the line");
  }
  switch (c) {
    case 'O': return fail_letter_o(at_);
    case 'N':
      return fail("gcode.unexpected-text", at_, 1, "a line number that is not at the start of its line",
                  "N as the first word, after '/' if there is one");
    case ':':
      return fail("gcode.unexpected-text", at_, 1, gcode_says::not_a_word.with({{"what", "':'"}}),
                  gcode_says::letter_o);
    case ')':
      return fail("gcode.unexpected-text", at_, 1, "')' without a comment before it", "'(' where the comment starts");
    case ',':
      if (after_number) return fail("gcode.bad-character", at_, 1, gcode_says::comma, gcode_says::decimal_point);
      break;
    case '.':
      if (after_number) {
        return fail("gcode.unexpected-text", at_, 1, gcode_says::second_point, gcode_says::one_point);
      }
      break;
    case '+':
    case '-':
    case '*':
      return fail("gcode.unexpected-text", at_, 1, fmt::format("{} outside brackets", found.name),
                  "square brackets around an expression, e.g. X[1+2]");
    case '/':
      if (at_ + 1 != end_ && at_[1] == '/') {
        return fail("gcode.unexpected-text", at_, 2, "'//' does not start a comment",
                    "a comment after ';', or (in brackets)");
      }
      return fail("gcode.unexpected-text", at_, 1, "'/' that is not at the start of its line",
                  "'/' as the first character (block delete), or square brackets around a division, e.g. X[1/2]");
    case '[':
    case ']':
    case '=':
    case '%':
      return fail("gcode.unexpected-text", at_, 1, gcode_says::not_a_word.with({{"what", found.name}}),
                  "a letter with a value, #parameter=value or a comment");
    default: break;
  }
  if (is_digit(c)) {
    return fail("gcode.unexpected-text", at_, 1, gcode_says::lone_number, gcode_says::letter_and_value);
  }
  return fail("gcode.bad-character", at_, found.length, gcode_says::no_meaning.with({{"what", found.name}}),
              found.cure);
}

bool LineParser::fail_in_brackets(const char* open) {
  const char c = peek();
  if (at_end()) {
    return fail("gcode.unclosed-bracket", open, 1, gcode_says::bracket_open, "']'");
  }
  const NamedCharacter found = name_character(rest(at_));
  if (c == '(' || c == ')') {
    return fail("gcode.unexpected-text", at_, 1, fmt::format("{} inside an expression", found.name),
                "square brackets in expressions: '(' starts a comment");
  }
  const bool after_number = is_digit(token_end_[-1]) || token_end_[-1] == '.';
  if (c == ',' && after_number)
    return fail("gcode.bad-character", at_, 1, gcode_says::comma, gcode_says::decimal_point);
  std::string expected = "an operator (+ - * / ** MOD EQ NE GT GE LT LE AND OR XOR) or ']'";
  if (!is_letter(c) && !found.cure.empty()) expected = found.cure;
  const bool is_plain = static_cast<unsigned char>(c) > 0x20 && static_cast<unsigned char>(c) < 0x7F;
  return fail(is_plain ? "gcode.unexpected-text" : "gcode.bad-character", at_, found.length,
              fmt::format("{} inside an expression", found.name), std::move(expected));
}

// Fanuc's macros have other words for the flow of control. What is wrong with their letters helps nobody.
bool LineParser::fail_foreign_word(const char* start) {
  struct Macro {
    std::string_view name;
    SentenceRow expected;
    bool has_condition = false;
  };
  constexpr Macro macros[] = {{"WHILE", gcode_says::for_while, true},
                              {"GOTO", gcode_says::for_goto},
                              {"THEN", gcode_says::for_then},
                              {"END", gcode_says::for_end},
                              {"IF", gcode_says::for_if, true}};
  // `I F100` is an I that lacks its value.
  std::string name;
  const char* at = start;
  while (at != end_ && is_letter(*at)) name += to_upper(*at++);
  while (at != end_ && is_blank(*at)) ++at;
  const bool has_condition = at != end_ && *at == '[';
  const auto* const found = std::ranges::find_if(
      macros, [&](const Macro& macro) { return name == macro.name && (has_condition || !macro.has_condition); });
  if (found == std::end(macros)) return false;
  return fail("gcode.fanuc-macro", start, found->name.size(),
              gcode_says::fanuc_word.with({{"name", std::string(found->name)}}), found->expected);
}

bool LineParser::fail_function(const char* name_start, std::string_view name) {
  std::string upper;
  std::ranges::transform(name, std::back_inserter(upper), to_upper);
  const std::string_view meant = guess(upper, {"ABS", "ACOS", "ASIN", "ATAN", "COS", "EXISTS", "EXP", "FIX", "FUP",
                                               "LN", "ROUND", "SIN", "SQRT", "TAN"});
  return fail("gcode.unknown-function", name_start, name.size(),
              gcode_says::no_function.with({{"name", shortened(upper)}}),
              meant.empty() ? "ABS ACOS ASIN ATAN COS EXISTS EXP FIX FUP LN ROUND SIN SQRT or TAN"
                            : fmt::format("{}, perhaps", meant));
}

bool LineParser::fail_assignment(const char* target) {
  const Span span = span_from(target);
  return fail("gcode.unexpected-text", target, span.length,
              fmt::format("parameter {} without '=' and a value", shortened({target, span.length})),
              "'=' and the value, e.g. #1=2.5, or a letter before the '#', e.g. X#1");
}

bool LineParser::fail_letter_o(const char* o) {
  return fail("gcode.bad-o-word", o, 1, "the letter O inside a line",
              "the digit 0, or an O-word as the first word of its line");
}

bool LineParser::fail_control_keyword(const char* start, std::string_view keyword) {
  constexpr const char* all =
      "sub, endsub, call, return, if, elseif, else, endif, while, endwhile, do, repeat, endrepeat, break or continue";
  if (keyword.empty()) {
    const NamedCharacter found = name_character(rest(at_));
    return fail("gcode.bad-o-word", at_, found.length, fmt::format("{} after the label of an O-word", found.name), all);
  }
  const std::string_view meant =
      guess(keyword, {"SUB", "ENDSUB", "CALL", "RETURN", "DO", "WHILE", "ENDWHILE", "IF", "ELSEIF", "ELSE", "ENDIF",
                      "REPEAT", "ENDREPEAT", "BREAK", "CONTINUE"});
  const std::string written = shortened({start, static_cast<std::size_t>(token_end_ - start)});
  return fail("gcode.bad-o-word", start, span_from(start).length, fmt::format("an O-word cannot {}", written),
              meant.empty() ? all : fmt::format("{}, perhaps", meant));
}

}  // namespace passo
