#include "tokens.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace passo {

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_name(const Token& token) {
  return !token.text.empty() && is_of_word(token.text.front()) &&
         std::isdigit(static_cast<unsigned char>(token.text.front())) == 0;
}
bool is_type_key(std::string_view word) {
  return word == "class" || word == "struct" || word == "enum" || word == "union";
}

namespace {

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {}

  std::vector<Token> tokens() {
    while (at_ < text_.size()) read_one();
    return std::move(tokens_);
  }

 private:
  void read_one() {
    const char c = text_[at_];
    if (std::isspace(static_cast<unsigned char>(c)) != 0) return go_to(at_ + 1);
    if (text_.substr(at_, 2) == "//") return go_to(text_.find('\n', at_));
    if (text_.substr(at_, 2) == "/*") return go_to(text_.find("*/", at_ + 2), 2);
    if (c == '#') return skip_directive();
    if (text_.substr(at_, 2) == "R\"") return skip_raw_string();
    if (c == '"' || c == '\'') return skip_quoted(c);
    if (is_of_word(c)) {
      // 115'200 is one number.
      const bool number = std::isdigit(static_cast<unsigned char>(c)) != 0;
      std::size_t end = at_;
      while (end < text_.size() && (is_of_word(text_[end]) || (number && text_[end] == '\''))) ++end;
      return add(end - at_);
    }
    add(text_.substr(at_, 2) == "::" ? 2 : 1);
  }

  void add(std::size_t length) {
    tokens_.push_back({std::string(text_.substr(at_, length)), line_});
    at_ += length;
  }
  void go_to(std::size_t place, std::size_t beyond = 0) {
    const std::size_t end = place == std::string_view::npos ? text_.size() : place + beyond;
    line_ += static_cast<std::size_t>(std::ranges::count(text_.substr(at_, end - at_), '\n'));
    at_ = end;
  }
  void skip_directive() {
    std::size_t end = text_.find('\n', at_);
    while (end != std::string_view::npos && text_[end - 1] == '\\') end = text_.find('\n', end + 1);
    go_to(end);
  }
  void skip_raw_string() {
    const std::size_t open = text_.find('(', at_);
    std::string close(1, ')');
    close.append(text_.substr(at_ + 2, open - at_ - 2)).push_back('"');
    go_to(text_.find(close, open), close.size());
  }
  void skip_quoted(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote) end += text_[end] == '\\' ? 2 : 1;
    go_to(end, 1);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokens_of(std::string_view text) {
  return Lexer(text).tokens();
}

std::size_t behind_bracket(Tokens tokens, std::size_t open) {
  const char opening = tokens[open].text[0];
  const char closing = opening == '(' ? ')' : opening == '[' ? ']' : opening == '<' ? '>' : '}';
  int depth = 0;
  for (std::size_t i = open; i < tokens.size(); ++i) {
    const char first = tokens[i].text[0];  // a bracket is a token of its own
    if (first == opening) ++depth;
    if (first == closing && --depth == 0) return i + 1;
  }
  return tokens.size();
}

Tokens without_preamble(Tokens statement) {
  for (;;) {
    if (statement.size() > 1 && statement[0].text == "template" && statement[1].text == "<") {
      statement = statement.subspan(behind_bracket(statement, 1));
    } else if (!statement.empty() && statement[0].text == "[") {
      statement = statement.subspan(behind_bracket(statement, 0));
    } else {
      return statement;
    }
  }
}

}  // namespace passo
