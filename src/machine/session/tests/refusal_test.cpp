#include "passo/session/refusal.hpp"

#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "passo/interpreter/tool_change_plan.hpp"
#include "passo/session/request_checks.hpp"

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

TEST(Refusals, keep_the_collet_of_a_rack_closed) {
  MachineDescription machine;
  EXPECT_FALSE(refusal_of(request::SwitchOutputs{.mist = true}, machine));
  ToolChangePlan plan;
  plan.way = ToolChangeWay::rack;
  plan.rack.opens = ColletOutput::flood;
  machine.tool_change = std::make_shared<const ToolChangePlan>(plan);
  EXPECT_FALSE(refusal_of(request::SwitchOutputs{.mist = true, .spindle_stands = true}, machine));
  for (const bool on : {false, true}) {
    const auto refusal = refusal_of(request::SwitchOutputs{.flood = on}, machine);
    ASSERT_TRUE(refusal) << on;
    EXPECT_EQ(refusal->message(), "this output opens the collet: only a tool change switches it");
  }
}

}  // namespace
}  // namespace passo
