// The sentences of what is found in any TOML file of a user. A row is a stable code, by which clients translate it, and
// the English text. The page has the same codes (page/src/lang/LANGUAGE/findings.ts). A test compares the two.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::toml_says {

inline constexpr SentenceRow key_is{"machine.bad-value", "{key} is {value}"};
inline constexpr SentenceRow number_within{"expected.number-within", "a number from {low} to {high}"};
inline constexpr SentenceRow whole_number_within{"expected.whole-number-within", "a whole number from {low} to {high}"};
inline constexpr SentenceRow lacks{"machine.missing-key", "{where} lacks {what}"};
inline constexpr SentenceRow unknown_key{"machine.unknown-key", "{where} has no key {key}"};
inline constexpr SentenceRow unknown_table{"machine.unknown-table", "{where} has no table {key}"};

}  // namespace passo::toml_says
