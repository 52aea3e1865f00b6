#include "passo/activity/machine_fault.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(MachineFaults, have_a_code_and_a_sentence_each) {
  std::set<std::string_view> codes;
  for (const MachineFaultRow& row : machine_fault_rows()) {
    EXPECT_TRUE(codes.insert(row.code).second) << row.code;
    EXPECT_NE(row.code.find('.'), std::string_view::npos) << row.code;
    EXPECT_FALSE(row.sentence.empty()) << row.code;
    EXPECT_FALSE(row.sentence.ends_with('.')) << row.code;
    EXPECT_EQ(&row, &row_of(row.fault)) << row.code;
  }
}

TEST(MachineFaults, fill_their_arguments_into_the_sentence) {
  const ActivityFault lost{MachineFault::board_lost, {{"trouble", "the board does not answer"}}};
  EXPECT_EQ(lost.code(), "board.lost");
  EXPECT_EQ(lost.message(), "the board does not answer");
  const std::string waits =
      ActivityFault{MachineFault::program_waits, {{"program", "a{wait}.ngc"}, {"wait", "M0"}}}.message();
  EXPECT_TRUE(waits.starts_with("a{wait}.ngc waits at M0, but there is no terminal")) << waits;
  EXPECT_EQ(ActivityFault{MachineFault::switch_not_met}.message(), "its switch was not triggered");
}

TEST(MachineFaults, of_homing_and_probing_have_a_number_of_grbl) {
  EXPECT_EQ(row_of(MachineFault::switch_not_met).alarm, GrblAlarm::homing_no_switch);
  EXPECT_EQ(row_of(MachineFault::switch_still_closed).alarm, GrblAlarm::homing_no_release);
  EXPECT_EQ(row_of(MachineFault::switch_unsteady).alarm, GrblAlarm::homing_no_release);
  EXPECT_EQ(row_of(MachineFault::probe_before).alarm, GrblAlarm::probe_before);
  EXPECT_EQ(row_of(MachineFault::probe_untouched).alarm, GrblAlarm::probe_untouched);
}

TEST(MachineFaults, of_the_board_are_told_from_those_of_the_work) {
  for (const MachineFaultRow& row : machine_fault_rows()) {
    EXPECT_EQ(is_of_board(row.fault), row.code.starts_with("board.")) << row.code;
  }
}

}  // namespace
}  // namespace passo
