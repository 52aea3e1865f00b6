// C++ text as words and brackets, for tests that read the project's own sources.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct Token {
  std::string text;
  std::size_t line = 0;
};
using Tokens = std::span<const Token>;

// Words, numbers, `::` and single characters. Comments, lines of the preprocessor and the insides of quotes are left
// out.
std::vector<Token> tokens_of(std::string_view text);

bool is_of_word(char c);
bool is_name(const Token& token);
// class, struct, enum or union.
bool is_type_key(std::string_view word);
// The token behind the bracket that closes the one at `open`.
std::size_t behind_bracket(Tokens tokens, std::size_t open);
// Without template<…> and [[attributes]] before it.
Tokens without_preamble(Tokens statement);

}  // namespace passo
