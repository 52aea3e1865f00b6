#include "declared_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <span>

namespace passo {
namespace {

struct Token {
  std::string text;
  std::size_t line = 0;
};
using Tokens = std::span<const Token>;

bool is_of_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_name(const Token& token) {
  return !token.text.empty() && is_of_word(token.text.front()) &&
         std::isdigit(static_cast<unsigned char>(token.text.front())) == 0;
}

// Words, numbers, `::` and single characters. Comments, lines of the preprocessor and the insides of quotes are left
// out.
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

// The token behind the bracket that closes the one at `open`.
std::size_t behind_bracket(Tokens tokens, std::size_t open) {
  const std::string opening = tokens[open].text;
  const std::string closing = opening == "(" ? ")" : opening == "[" ? "]" : opening == "<" ? ">" : "}";
  int depth = 0;
  for (std::size_t i = open; i < tokens.size(); ++i) {
    if (tokens[i].text == opening) ++depth;
    if (tokens[i].text == closing && --depth == 0) return i + 1;
  }
  return tokens.size();
}

// Without template<…> and [[attributes]] before it.
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

bool is_type_key(const std::string& word) {
  return word == "class" || word == "struct" || word == "enum" || word == "union";
}

// One parameter's type, without its name, its default value, and what makes no other meaning: const and &.
std::string type_of_parameter(Tokens parameter) {
  static const std::set<std::string> fundamental = {"int",  "unsigned", "long",  "short", "char",
                                                    "bool", "double",   "float", "auto",  "void"};
  std::vector<std::string> words;
  for (const Token& token : parameter) {
    if (token.text == "=") break;
    if (token.text != "const" && token.text != "&") words.push_back(token.text);
  }
  const auto is_word = [](const std::string& text) { return is_of_word(text.front()); };
  const bool named =
      words.size() > 1 && is_word(words.back()) && !fundamental.contains(words.back()) &&
      (is_word(words[words.size() - 2]) || words[words.size() - 2] == ">" || words[words.size() - 2] == "*");
  if (named) words.pop_back();
  std::string type;
  for (const std::string& word : words) {
    if (!type.empty() && is_word(word) && is_of_word(type.back())) type += ' ';
    type += word;
  }
  return type;
}

std::string parameters_in(Tokens list) {
  std::string types;
  std::size_t begin = 0;
  int depth = 0;
  for (std::size_t i = 0; i <= list.size(); ++i) {
    const std::string text = i < list.size() ? list[i].text : ",";
    if (text == "(" || text == "<" || text == "{") ++depth;
    if (text == ")" || text == ">" || text == "}") --depth;
    if (text != "," || (depth > 0 && i < list.size())) continue;
    const std::string type = type_of_parameter(list.subspan(begin, i - begin));
    if (!types.empty() && !type.empty()) types += ", ";
    types += type;
    begin = i + 1;
  }
  return types;
}

class Reader {
 public:
  explicit Reader(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  std::vector<DeclaredName> names() {
    std::size_t begin = 0;  // of a statement
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const std::string& text = tokens_[i].text;
      const Tokens statement = without_preamble(Tokens(tokens_).subspan(begin, i - begin));
      if (text == "(" || text == "[") {
        i = behind_bracket(tokens_, i) - 1;
      } else if (text == ";") {
        read_declaration(statement);
        begin = i + 1;
      } else if (text == "}") {
        if (!scopes_.empty()) scopes_.pop_back();
        begin = i + 1;
      } else if (text == "{") {
        const std::size_t behind = behind_bracket(tokens_, i);
        if (opens_scope(statement) && !is_anonymous(statement)) {
          scopes_.push_back(scope_of(statement));
          begin = i + 1;
        } else {
          // A function ends with its body; a type and a variable with a semicolon.
          const bool ended = is_anonymous(statement) || read_body(statement);
          i = behind - 1;
          if (ended) begin = behind;
        }
      }
    }
    return std::move(found_);
  }

 private:
  static bool opens_scope(Tokens statement) {
    if (statement.empty()) return false;
    return statement[0].text == "namespace" || statement[0].text == "extern" ||
           (statement.size() > 1 && statement[0].text == "inline" && statement[1].text == "namespace");
  }
  static bool is_anonymous(Tokens statement) { return statement.size() == 1 && statement[0].text == "namespace"; }
  static std::string scope_of(Tokens statement) {
    std::string scope;
    for (const Token& token : statement) {
      if (token.text != "namespace" && token.text != "inline" && token.text != "extern") scope += token.text;
    }
    return scope;
  }

  // What stands before a body. Does the body end the statement?
  bool read_body(Tokens statement) {
    if (statement.empty()) return true;
    if (is_type_key(statement[0].text)) {
      read_type(statement);
      return false;
    }
    return read_function(statement);
  }

  void read_declaration(Tokens statement) {
    if (statement.size() > 2 && statement[0].text == "using" && statement[2].text == "=") {
      add(DeclaredName::Kind::type, statement[1], "");
    } else if (!statement.empty() && !is_type_key(statement[0].text)) {
      read_function(statement);
    }
  }

  // class [[…]] Name final : public Base
  void read_type(Tokens statement) {
    for (std::size_t i = 1; i < statement.size(); ++i) {
      if (statement[i].text == "[") {
        i = behind_bracket(statement, i) - 1;
      } else if (is_name(statement[i]) && !is_type_key(statement[i].text)) {
        const bool qualified = i + 1 < statement.size() && statement[i + 1].text == "::";
        const bool specialised = i + 1 < statement.size() && statement[i + 1].text == "<";
        if (!qualified && !specialised) add(DeclaredName::Kind::type, statement[i], "");
        return;
      }
    }
  }

  // Type name(Parameter name, …). Is this a function, even one of another scope or none for others?
  bool read_function(Tokens statement) {
    static constexpr std::array<std::string_view, 4> no_functions = {"using", "static_assert", "friend", "typedef"};
    if (statement.empty() || std::ranges::find(no_functions, statement[0].text) != no_functions.end()) return false;
    std::size_t begin = 0;  // of its name
    std::size_t open = 0;
    while (open < statement.size() && statement[open].text != "(" && statement[open].text != "=") {
      begin = open;
      // Operators are named by several tokens: `operator==`, `operator()`.
      const std::size_t more = statement[open].text == "operator" ? 2 : 1;
      for (open += more; more == 2 && open < statement.size() && statement[open].text != "(";) ++open;
    }
    if (open >= statement.size() || open == 0 || statement[open].text != "(") return false;
    // A constructor or a macro has nothing before its name.
    if (begin == 0 || !is_name(statement[begin])) return true;
    if (statement[begin - 1].text == "::" || statement[0].text == "static") return true;
    Token name{"", statement[begin].line};
    for (std::size_t i = begin; i < open; ++i) name.text += statement[i].text;
    const std::size_t behind = behind_bracket(statement, open);
    add(DeclaredName::Kind::function, name, parameters_in(statement.subspan(open + 1, behind - open - 2)));
    return true;
  }

  void add(DeclaredName::Kind kind, const Token& name, std::string parameters) {
    std::string scope;
    for (const std::string& part : scopes_) scope += (scope.empty() || part.empty() ? "" : "::") + part;
    found_.push_back({kind, name.line, std::move(scope), name.text, std::move(parameters)});
  }

  std::vector<Token> tokens_;
  std::vector<std::string> scopes_;
  std::vector<DeclaredName> found_;
};

}  // namespace

std::vector<DeclaredName> declared_names(std::string_view text) {
  return Reader(Lexer(text).tokens()).names();
}

}  // namespace passo
