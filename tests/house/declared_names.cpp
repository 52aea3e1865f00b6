#include "declared_names.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "tokens.hpp"

namespace passo {
namespace {

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
  return Reader(tokens_of(text)).names();
}

}  // namespace passo
