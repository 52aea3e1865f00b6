#include "passo/job/job_entry.hpp"

#include "kit/example_machine.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// A probe move is three items: its beginning, the motion and its end.
ProgramReader program() {
  return ProgramReader::from_text("t",
                                  "G21 G90 G61.1 F600\n"
                                  "G1 X3\n"           // item 0
                                  "G38.3 Z-20 F60\n"  // 1
                                  "G1 X5\n"           // 4
                                  "G38.3 Z-30\n"      // 5
                                  "G1 X9\n"           // 8
                                  "M2\n");
}

class JobEntries : public testing::Test {
 protected:
  JobEntries() {
    head_.job_counts = {1000, 0, -50};
    ProbeOutcome touched;
    touched.touched = true;
    touched.rest = touched.contact = {{{3, 0, -8}}};
    head_.probes = {touched, touched};
  }
  ResumePoint point_at(std::uint64_t item, double s) const {
    const auto point =
        find_resume_point(program(), machine_, InterpreterOptions(), {.item = item, .s = Mm(s)}, head_.probes);
    EXPECT_TRUE(point);
    return point.value_or(ResumePoint());
  }
  BoardStatus at(const ResumePoint& point) const {
    BoardStatus status{.session = 99, .executed = 20, .state = board_trusted, .motors = 3};
    for (std::size_t m = 0; m < 3; ++m) {
      status.positions[m] = static_cast<std::int32_t>(point.steps[m]) + head_.job_counts[m];
    }
    return status;
  }

  MachineDescription machine_ = test::example_machine("router");
  JournalHead head_;
};

TEST_F(JobEntries, begin_where_the_board_rests) {
  const ResumePoint point = point_at(4, 1);
  EXPECT_EQ(point.probes, 1U);
  const JobEntry entry = entry_at_rest(head_, point, at(point), machine_);
  EXPECT_EQ(entry.at.place, point.place);
  EXPECT_TRUE(entry.lead_in.empty()) << "it stands there";
  ASSERT_TRUE(entry.stands);
  EXPECT_NEAR((*entry.stands)[Axis::x], 4, 1e-9);
  EXPECT_EQ(entry.probes.size(), 1U) << "the probe move behind the place is made again";
}

TEST_F(JobEntries, go_back_to_the_beginning_of_a_probe_move_that_nobody_has_seen_end) {
  head_.probes.resize(1);
  const ResumePoint point = point_at(6, 5);
  ASSERT_TRUE(point.probe);
  BoardStatus amid = at(point);
  amid.positions[2] -= static_cast<std::int32_t>(5 * machine_.axes[2].steps_per_unit);
  const JobEntry entry = entry_at_rest(head_, point, amid, machine_);
  ASSERT_TRUE(entry.stands);
  EXPECT_NEAR((*entry.stands)[Axis::z], point.point[Axis::z] - 5, 1e-9);
  ASSERT_FALSE(entry.lead_in.empty());
  EXPECT_EQ(std::get<Segment>(entry.lead_in.back()).curve.end(), point.point);
}

TEST_F(JobEntries, are_led_to_from_beside_the_path) {
  head_.probes.resize(1);
  ResumePoint point = point_at(4, 1);
  Point beside = point.point;
  beside[Axis::y] += 10;
  const auto way = plan_reentry(machine_, point, beside);
  ASSERT_TRUE(way) << message_of(way.error());
  const JobEntry entry = entry_by_way(*way, {ProbeOutcome(), ProbeOutcome()});
  EXPECT_FALSE(entry.stands) << "the session knows where the machine stands";
  EXPECT_EQ(entry.lead_in.size(), way->lead_in.size());
  EXPECT_EQ(entry.probes.size(), 1U);
  request::Start start{.program = program(), .options = {}};
  enter(start, entry);
  ASSERT_TRUE(start.from);
  EXPECT_EQ(start.from->place, point.place);
  EXPECT_EQ(start.lead_in.size(), way->lead_in.size());
  EXPECT_EQ(start.known_probes.size(), 1U);
}

// The way to a line, as a person asks for it: what the command line and the API both call.
TEST_F(JobEntries, are_found_by_a_line_or_say_why_not) {
  const auto straight = ProgramReader::from_text("t", "G21 G90 F600\nG1 X3\nG1 Y4\nM2\n");
  InterpreterOptions options;
  options.start[Axis::x] = 50;
  const auto way = reentry_at_line(straight, machine_, options, {.line = 3});
  ASSERT_TRUE(way) << message_of(way.error());
  EXPECT_EQ(way->at.line, 3U);
  EXPECT_FALSE(way->lead_in.empty());
  EXPECT_EQ(reentry_at_line(straight, machine_, options, {.line = 9}).error().refusal, ReentryRefusal::no_motion);
  machine_.axes[0].screw = ScrewDescription{.backlash = 0.1};
  EXPECT_EQ(reentry_at_line(straight, machine_, options, {.line = 3}).error().refusal, ReentryRefusal::backlash);
}

}  // namespace
}  // namespace passo
