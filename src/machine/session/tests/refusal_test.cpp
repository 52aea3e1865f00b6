#include "passo/session/refusal.hpp"

#include <set>

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(Refusals, have_a_code_of_their_own_that_begins_with_the_code_that_clients_compare) {
  std::set<std::string_view> codes;
  for (const RefusalRow& row : refusal_rows()) {
    EXPECT_TRUE(codes.insert(row.finer_code).second) << row.finer_code;
    EXPECT_TRUE(row.finer_code.starts_with(code_of(row.code))) << row.finer_code;
    EXPECT_FALSE(row.sentence.empty() || row.sentence.ends_with('.')) << row.finer_code;
    EXPECT_EQ(&row, &row_of(row.reason)) << row.finer_code;
  }
}

TEST(Refusals, are_sentences_with_their_arguments) {
  const Refusal refusal{RefusalReason::limit_switch_of_axis, {{"axis", "Y"}}};
  EXPECT_EQ(refusal.code(), RefusalCode::alarm);
  EXPECT_EQ(refusal.message(), "the limit switch of Y closed: reset the machine first");
  const Sentence sentence = refusal.sentence();
  EXPECT_EQ(sentence.code, "machine.alarm.limit-switch-of-axis");
  EXPECT_EQ(sentence.arguments.front().second, "Y");
  EXPECT_EQ(sentence.text, refusal.message());
}

}  // namespace
}  // namespace passo
