#include "passo/diagnostics/finding_words.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {
namespace {

constexpr SentenceRow row{"area.key", "{key} is {value}"};

TEST(FindingWords, keep_the_code_and_the_arguments_of_a_row) {
  const FindingWords words = row.with({{"key", "X"}, {"value", "{key}"}});
  EXPECT_EQ(words, "X is {key}");
  EXPECT_EQ(words.sentence(), (Sentence{"area.key", {{"key", "X"}, {"value", "{key}"}}, "X is {key}"}));
  EXPECT_EQ(FindingWords(SentenceRow{"area.none", "nothing"}).sentence(), (Sentence{"area.none", {}, "nothing"}));
}

TEST(FindingWords, of_a_mere_text_have_no_code) {
  const FindingWords words = "a text";
  EXPECT_EQ(words.sentence(), (Sentence{"", {}, "a text"}));
}

TEST(FindingWords, are_held_by_another_sentence_with_their_code) {
  EXPECT_EQ(held_as("finding", "a text"), (SentenceArguments{{"finding", "a text"}}));
  EXPECT_EQ(held_as("finding", row.with({{"key", "X"}, {"value", "0"}})),
            (SentenceArguments{{"finding", "X is 0"},
                               {"finding.code", "area.key"},
                               {"finding.arguments.key", "X"},
                               {"finding.arguments.value", "0"}}));
}

TEST(FindingWords, lose_the_code_when_an_error_is_in_doubt) {
  Diagnostics diagnostics;
  diagnostics.doubt_errors("perhaps");
  Diagnostic error;
  error.message = row.with({{"key", "X"}, {"value", "0"}});
  diagnostics.add(std::move(error));
  EXPECT_EQ(diagnostics.all().front().message.sentence(), (Sentence{"", {}, "X is 0, perhaps"}));
}

}  // namespace
}  // namespace passo
