#include "passo/journal/resumption.hpp"

#include "kit/memory_store.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

MachineDescription two_axes() {
  MachineDescription machine;
  for (const Axis axis : {Axis::x, Axis::y}) {
    machine.axes.push_back({.axis = axis,
                            .steps_per_unit = 100,
                            .travel_low = -100,
                            .travel_high = 100,
                            .velocity = MmPerSecond(50),
                            .acceleration = MmPerSecond2(500),
                            .motor = {},
                            .inverted = axis == Axis::y});
  }
  return machine;
}

// Exact stops, so that the items of the path are those of the program.
ProgramReader program() {
  return ProgramReader::from_text("t",
                                  "G21 G90 G61.1 F600\n"
                                  "X3 G1\n"           // item 0
                                  "M3 S1000\n"        // 1
                                  "G4 P2\n"           // 2
                                  "G4 P.5\n"          // 3
                                  "G1 Y4.321\n"       // 4
                                  "M8\n"              // 5
                                  "G4 P1\n"           // 6
                                  "G1 X13 Y14.321\n"  // 7
                                  "M2\n");
}

std::optional<ResumePoint> point_at(std::uint64_t item, double s = 0, const InterpreterOptions& options = {}) {
  return find_resume_point(program(), two_axes(), options, {.item = item, .s = Mm(s)});
}

// A machine that was homed before.
TEST(ResumePoints, count_from_machine_zero_wherever_the_job_began) {
  InterpreterOptions options;
  options.start[Axis::x] = -50.5;
  const auto start = point_at(0, 0, options);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->point[Axis::x], -50.5);
  EXPECT_EQ(start->steps[0], -5050);
  const auto amid = point_at(0, 10, options);
  ASSERT_TRUE(amid);
  EXPECT_EQ(amid->steps[0], -4050);
}

TEST(ResumePoints, know_that_they_are_in_a_thread) {
  MachineDescription lathe = two_axes();
  const auto point = [&](std::uint64_t item, double s) {
    const auto thread = ProgramReader::from_text("t", "G21 G90 G61.1 S600 M3\nG0 X3\nG33 X9 K1\nG0 Y1\nM2\n");
    return find_resume_point(thread.again(), lathe, InterpreterOptions(), {.item = item, .s = Mm(s)});
  };
  // M3, the rapid, the wait for the index, the thread, the way out.
  lathe.spindle.counts_per_turn = 1000;
  EXPECT_FALSE(point(2, 0)->in_thread) << "it begins there";
  EXPECT_TRUE(point(3, 2)->in_thread);
  EXPECT_FALSE(point(4, 0.5)->in_thread);
  lathe.spindle.counts_per_turn = 0;
  EXPECT_FALSE(point(3, 2)->in_thread) << "it follows no encoder";
}

TEST(ResumePoints, stand_where_the_path_is_and_name_the_line) {
  const auto start = point_at(0);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->line, 2U);
  EXPECT_EQ(start->steps[0], 0);
  const auto amid = point_at(0, 1.234);
  ASSERT_TRUE(amid);
  EXPECT_EQ(amid->point[Axis::x], 1.234);
  EXPECT_EQ(amid->steps[0], 123);
  const auto second = point_at(4, 2);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->line, 6U);
  EXPECT_EQ(second->steps[0], 300);
  EXPECT_EQ(second->steps[1], -200) << "its motor turns the other way";
  const auto behind = point_at(5);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->steps[1], -432);
}

TEST(ResumePoints, have_the_outputs_of_the_place_and_wait_as_long_for_the_spindle_as_the_program_did) {
  EXPECT_EQ(point_at(1)->outputs, OutputState());
  EXPECT_EQ(point_at(1)->spindle_wait, Seconds(0));
  EXPECT_EQ(point_at(2)->spindle_wait, Seconds(0)) << "the program itself still waits";
  const auto cutting = point_at(4, 1);
  ASSERT_TRUE(cutting);
  EXPECT_EQ(cutting->outputs.spindle, SpindleDirection::clockwise);
  EXPECT_FALSE(cutting->outputs.flood);
  EXPECT_EQ(cutting->spindle_wait, Seconds(2.5)) << "both dwells";
  EXPECT_TRUE(point_at(7)->outputs.flood);
  EXPECT_EQ(point_at(7)->spindle_wait, Seconds(2.5)) << "a dwell amid the cut is not for the spindle";
}

TEST(ResumePoints, are_not_where_the_path_does_not_go) {
  EXPECT_TRUE(point_at(10)) << "the end: M2 is two items, outputs off and the end itself";
  EXPECT_EQ(point_at(10)->line, 0U);
  EXPECT_FALSE(point_at(11));
  EXPECT_FALSE(point_at(0, 3));
  EXPECT_FALSE(point_at(2, 0.5)) << "amid a dwell";
}

// A job that began at 1000 and -50, and a board that rests in the second move.
class Resumptions : public testing::Test {
 protected:
  Resumptions() {
    JournalWriter writer(store_);
    JournalHead head;
    head.job_counts = {1000, -50};
    head.numbers.greeting = 7;
    head.numbers.session = 99;
    writer.begin(head);
    writer.record({.executed = 20, .place = {.item = 4, .s = Mm(2)}});
    status_.positions[0] = 1300;
    status_.positions[1] = -250;
  }
  // Code of the refusal; empty: it goes on.
  std::string refusal() const {
    const auto journal = Journal::read(store_.bytes);
    const auto point = resume_point_of(journal.value_or(Journal()), status_, program(), two_axes(), {});
    return point ? "" : std::string(code_of(point.error()));
  }

  test::MemoryStore store_;
  BoardStatus status_{.session = 99, .executed = 20, .state = board_trusted, .motors = 2};
};

TEST_F(Resumptions, go_on_where_journal_and_counts_agree) {
  EXPECT_EQ(refusal(), "");
}

TEST_F(Resumptions, are_refused_where_the_counts_are_others_by_a_single_step) {
  status_.positions[1] += 1;
  EXPECT_EQ(refusal(), "resume.counts-differ");
}

TEST_F(Resumptions, are_refused_where_the_board_was_reset_or_used_by_others) {
  status_.session = 98;
  EXPECT_EQ(refusal(), "resume.other-session");
  status_ = {.session = 0, .state = board_trusted};
  EXPECT_EQ(refusal(), "resume.board-reset");
}

// Manual mode ends the session, and the board still knows its motors.
TEST_F(Resumptions, are_refused_where_the_machine_was_moved_by_the_keypad) {
  status_ = {.session = 0, .executed = 7, .state = board_trusted, .motors = 3};
  EXPECT_EQ(refusal(), "resume.session-ended");
}

TEST_F(Resumptions, are_refused_where_the_drivers_were_switched_off) {
  status_.state = 0;
  status_.inputs = drivers_timed_out;
  EXPECT_EQ(refusal(), "resume.drivers-off");
  status_.inputs = 0;
  EXPECT_EQ(refusal(), "resume.not-trusted");
}

TEST_F(Resumptions, are_refused_where_steps_may_be_lost_or_the_rest_is_not_known) {
  status_.executed = 19;
  EXPECT_EQ(refusal(), "resume.rest-unknown");
  status_.state = 0;
  EXPECT_EQ(refusal(), "resume.not-trusted");
}

}  // namespace
}  // namespace passo
