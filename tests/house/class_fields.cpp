#include "class_fields.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tokens.hpp"

namespace passo {
namespace {

template <std::size_t n>
bool is_one_of(const Token& token, const std::array<std::string_view, n>& words) {
  return std::ranges::find(words, token.text) != words.end();
}

bool opens_namespace(Tokens statement) {
  static constexpr std::array<std::string_view, 2> openers = {"namespace", "extern"};
  return is_one_of(statement[0], openers) ||
         (statement.size() > 1 && statement[0].text == "inline" && statement[1].text == "namespace");
}

// One statement of a scope, as far as it was read.
class Statement {
 public:
  explicit Statement(Tokens tokens) : tokens_(tokens), is_type_(is_type_key(tokens[0].text)) {}

  Tokens tokens() const { return tokens_; }
  std::size_t at() const { return at_; }
  bool has_ended() const { return at_ >= tokens_.size() || tokens_[at_].text == ";"; }
  bool is_at(std::string_view text) const { return tokens_[at_].text == text; }
  Tokens before() const { return tokens_.first(at_); }
  Tokens inside() const { return tokens_.subspan(at_ + 1, behind_bracket(tokens_, at_) - at_ - 2); }
  void pass_bracket() { at_ = behind_bracket(tokens_, at_); }

  // Whether the bracket here opens the body of a type, or of a function.
  bool is_at_type() const { return is_type_ && !is_assigned_ && !is_function_ && body_end_ == 0; }
  bool is_at_function() const { return is_function_ && !is_assigned_ && !is_at_initializer(); }
  void pass_type() {
    pass_bracket();
    body_end_ = at_;
    commas_ = 0;
  }

  // Passes a token that opens no body.
  void pass() {
    const std::string& text = tokens_[at_].text;
    if (text == "operator") return pass_operator();
    if (text == "decltype" || text == "alignas") {
      ++at_;
      return pass_bracket();
    }
    if (text == "(") is_function_ = is_function_ || !is_assigned_;
    if (text == "(" || text == "[" || text == "{") return pass_bracket();
    if (text == "<" && !is_assigned_ && !is_function_ && at_ > 0 && is_name(tokens_[at_ - 1])) return pass_bracket();
    if (text == "=") is_assigned_ = true;
    if (text == ":") initializes_ = is_function_;
    if (text == ",") ++commas_;
    ++at_;
  }

  std::size_t fields() const {
    static constexpr std::array<std::string_view, 4> no_fields = {"using", "friend", "typedef", "static_assert"};
    if (is_function_ || is_one_of(tokens_[0], no_fields)) return 0;
    for (std::size_t i = 0; i < std::min<std::size_t>(at_, 3); ++i) {
      if (tokens_[i].text == "static") return 0;
    }
    const bool declares_type = is_type_ && (tokens_[0].text == "enum" || at_ == 2 || body_end_ == at_);
    return declares_type ? 0 : 1 + commas_;
  }

 private:
  // `operator()` and `operator==`, up to the parameters.
  void pass_operator() {
    ++at_;
    if (is_at("(")) pass_bracket();
    while (!has_ended() && !is_at("(")) ++at_;
  }
  // : member_{1}
  bool is_at_initializer() const {
    static constexpr std::array<std::string_view, 3> before_bodies = {"const", "noexcept", "override"};
    const Token& last = tokens_[at_ - 1];
    return initializes_ && ((is_name(last) && !is_one_of(last, before_bodies)) || last.text == ">");
  }

  Tokens tokens_;
  std::size_t at_ = 0;
  bool is_type_;
  bool is_function_ = false;  // has parameters
  bool is_assigned_ = false;
  bool initializes_ = false;  // between a constructor's parameters and its body
  std::size_t body_end_ = 0;  // of a type
  std::size_t commas_ = 0;
};

class FieldCounter {
 public:
  // The fields of the class that the scope is the body of. A namespace has no owner and no fields.
  std::size_t read(Tokens scope, const std::string& owner) {
    std::size_t fields = 0;
    while (!(scope = without_preamble(scope)).empty()) {
      if (scope[0].text == ";") {
        scope = scope.subspan(1);
      } else if (is_access(scope)) {
        scope = scope.subspan(2);
      } else {
        const Counted counted = read_statement(scope, owner);
        fields += owner.empty() ? 0 : counted.fields;
        scope = scope.subspan(std::min(counted.tokens, scope.size()));
      }
    }
    return fields;
  }
  std::vector<ClassFields> found() { return std::move(found_); }

 private:
  struct Counted {
    std::size_t tokens = 0;
    std::size_t fields = 0;
  };

  static bool is_access(Tokens scope) {
    static constexpr std::array<std::string_view, 3> accesses = {"public", "private", "protected"};
    return scope.size() > 1 && is_one_of(scope[0], accesses) && scope[1].text == ":";
  }

  Counted read_statement(Tokens scope, const std::string& owner) {
    Statement statement(scope);
    while (!statement.has_ended()) {
      if (!statement.is_at("{")) {
        statement.pass();
      } else if (opens_namespace(scope)) {
        read(statement.inside(), "");
        statement.pass_bracket();
        return {.tokens = statement.at()};
      } else if (statement.is_at_type()) {
        if (scope[0].text != "enum") read_class(statement, owner);
        statement.pass_type();
      } else if (statement.is_at_function()) {
        statement.pass_bracket();
        return {.tokens = statement.at()};
      } else {
        statement.pass_bracket();
      }
    }
    return {.tokens = statement.at() + 1, .fields = statement.fields()};
  }

  // class [[…]] Name final : public Base
  void read_class(const Statement& statement, const std::string& owner) {
    std::string name = owner;
    const Tokens head = without_preamble(statement.before().subspan(1));
    if (!name.empty()) name += "::";
    for (const Token& token : head) {
      if (token.text == ":" || token.text == "final") break;
      name += token.text;
    }
    if (name.empty()) name = "(unnamed)";
    const std::size_t fields = read(statement.inside(), name);
    found_.push_back({.name = name, .line = statement.tokens()[0].line, .fields = fields});
  }

  std::vector<ClassFields> found_;
};

}  // namespace

std::vector<ClassFields> class_fields(std::string_view text) {
  const std::vector<Token> tokens = tokens_of(text);
  FieldCounter counter;
  counter.read(tokens, "");
  return counter.found();
}

}  // namespace passo
