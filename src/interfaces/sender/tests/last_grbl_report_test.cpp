#include "passo/sender/last_grbl_report.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

GrblReport report_of(const char* line) {
  return *read_grbl_report(line);
}

TEST(LastGrblReport, tell_news_of_state_and_place_alone) {
  LastGrblReport reports;
  EXPECT_TRUE(reports.hear(report_of("<Idle|MPos:1.000,2.000,3.000|Bf:15,128>"), Seconds(1)));
  EXPECT_FALSE(reports.hear(report_of("<Idle|MPos:1.000,2.000,3.000|Bf:14,100>"), Seconds(2)));
  EXPECT_TRUE(reports.hear(report_of("<Run|MPos:1.000,2.000,3.000>"), Seconds(3)));
  EXPECT_TRUE(reports.hear(report_of("<Run|MPos:1.000,2.000,3.100>"), Seconds(4)));
}

TEST(LastGrblReport, keep_the_offset_that_few_reports_tell) {
  LastGrblReport reports;
  const GrblMachine machine;
  EXPECT_FALSE(reports.place(machine));
  reports.hear(report_of("<Idle|WPos:1.000,2.000,3.000>"), Seconds(1));
  EXPECT_FALSE(reports.place(machine));
  reports.hear(report_of("<Idle|WPos:1.000,2.000,3.000|WCO:10.000,20.000,30.000>"), Seconds(2));
  reports.hear(report_of("<Idle|WPos:5.000,2.000,3.000>"), Seconds(3));
  EXPECT_EQ((*reports.place(machine))[Axis::x], 15);
  reports.hear(report_of("<Idle|MPos:7.000,2.000,3.000>"), Seconds(4));
  EXPECT_EQ((*reports.place(machine))[Axis::x], 7);
}

TEST(LastGrblReport, know_whether_they_came_after_something) {
  LastGrblReport reports;
  EXPECT_FALSE(reports.came_after(Seconds(-1)));
  reports.hear(report_of("<Idle|MPos:1.000,2.000,3.000>"), Seconds(5));
  EXPECT_TRUE(reports.came_after(Seconds(4)));
  EXPECT_FALSE(reports.came_after(Seconds(5)));
  reports.outdate();
  EXPECT_FALSE(reports.came_after(Seconds(4)));
  EXPECT_TRUE(reports.last());
}

}  // namespace
}  // namespace passo
