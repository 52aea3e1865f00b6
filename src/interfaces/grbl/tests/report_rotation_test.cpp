#include "passo/grbl/report_rotation.hpp"

#include <string>

#include <gtest/gtest.h>

namespace passo {
namespace {

class ReportTurnsTest : public testing::Test {
 protected:
  // "O": this report shows the work offset, "V": the overrides.
  char next(bool rests = true) {
    turns.choose(report, overrides, rests);
    return report.shows_offset ? 'O' : report.shows_overrides ? 'V' : '.';
  }
  std::string next_ones(int count, bool rests = true) {
    std::string shown;
    for (int i = 0; i < count; ++i) shown += next(rests);
    return shown;
  }

  ReportRotation turns;
  GrblStatus report;
  Overrides overrides;
};

TEST_F(ReportTurnsTest, show_the_two_in_turns) {
  EXPECT_EQ(next_ones(22), "OV........OV........OV");
  turns.begin();
  EXPECT_EQ(next_ones(32, false), "OV...................V........O.");
}

TEST_F(ReportTurnsTest, show_at_once_what_has_changed_the_offset_first) {
  next_ones(5);
  report.work_offset[Axis::x] = 1;
  overrides.feed = 0.5;
  EXPECT_EQ(next_ones(3), "OV.");
  report.outputs.mist = true;
  EXPECT_EQ(next(), 'V');
}

}  // namespace
}  // namespace passo
