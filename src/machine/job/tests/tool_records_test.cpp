#include "passo/job/tool_records.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "kit/folder_test.hpp"
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/job/cut_recorder.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

class ToolRecordsTest : public test::FolderTest {
 protected:
  std::string file() { return path("tools.sqlite"); }
  std::unique_ptr<ToolRecords> open() {
    auto opened = ToolRecords::open(file());
    EXPECT_TRUE(opened.has_value());
    return std::move(*opened);
  }
  static CutAmount amount(double mm, double s) { return {.length = Mm(mm), .time = Seconds(s)}; }
  static CutAmount cut_of(const ToolRecords& records, std::int32_t tool) {
    for (const ToolRecord& record : records.all()) {
      if (record.tool == tool) return record.cut;
    }
    return {};
  }
};

TEST_F(ToolRecordsTest, add_runs_and_survive_the_process) {
  {
    const auto records = open();
    EXPECT_TRUE(records->begin("m", "run 1"));
    EXPECT_TRUE(records->record("m", {{1, amount(100, 10)}}));
    EXPECT_TRUE(records->record("m", {{1, amount(300, 30)}, {2, amount(5, 1)}}));
    EXPECT_EQ(cut_of(*records, 1), amount(300, 30)) << "set, not added";
    EXPECT_TRUE(records->end("m"));
    EXPECT_TRUE(records->begin("m", "run 2"));
    EXPECT_TRUE(records->record("m", {{1, amount(50, 5)}}));
    EXPECT_EQ(cut_of(*records, 1), amount(350, 35));
  }
  const auto records = open();
  EXPECT_EQ(cut_of(*records, 1), amount(350, 35)) << "an open run counts";
  EXPECT_TRUE(records->begin("m", "run 3"));
  EXPECT_EQ(cut_of(*records, 1), amount(350, 35)) << "and is not lost when the next one begins";
  EXPECT_EQ(cut_of(*records, 2), amount(5, 1));
}

TEST_F(ToolRecordsTest, count_a_run_once_that_is_recovered_twice) {
  const auto records = open();
  records->begin("m", "run 1");
  records->record("m", {{1, amount(100, 20)}});
  EXPECT_TRUE(records->recover("m", "another run", {{1, amount(1e6, 1e6)}}));
  EXPECT_EQ(cut_of(*records, 1), amount(100, 20));
  // The path is 400 mm and 40 s long at the programmed feed; it took twice as long as far as was reported.
  EXPECT_TRUE(records->recover("m", "run 1", {{1, amount(400, 40)}, {2, amount(10, 1)}}));
  EXPECT_EQ(cut_of(*records, 1), amount(400, 20 + 30));
  EXPECT_EQ(cut_of(*records, 2), amount(10, 1));
  EXPECT_TRUE(records->recover("m", "run 1", {{1, amount(400, 40)}, {2, amount(10, 1)}}));
  EXPECT_EQ(cut_of(*records, 1), amount(400, 50));
  records->begin("m", "run 2");
  records->record("m", {{1, amount(1, 1)}});
  records->end("m");
  EXPECT_EQ(cut_of(*records, 1), amount(401, 51));
}

TEST_F(ToolRecordsTest, begin_anew_for_a_tool_that_is_replaced) {
  const auto records = open();
  records->begin("m", "run 1");
  records->record("m", {{1, amount(100, 10)}, {2, amount(7, 1)}});
  EXPECT_TRUE(records->replace(1, 1234));
  EXPECT_EQ(cut_of(*records, 1), CutAmount());
  records->record("m", {{1, amount(130, 12)}, {2, amount(7, 1)}});
  EXPECT_EQ(cut_of(*records, 1), amount(30, 2)) << "only what was cut since then";
  records->end("m");
  EXPECT_EQ(cut_of(*records, 1), amount(30, 2));
  EXPECT_EQ(cut_of(*records, 2), amount(7, 1));
  EXPECT_EQ(records->all().front().replaced_at, 1234);
  EXPECT_TRUE(records->replace(9, 5));
  EXPECT_EQ(records->all().back().tool, 9);
}

TEST_F(ToolRecordsTest, keep_two_machines_apart) {
  const auto one = open();
  const auto other = open();
  one->begin("a", "run");
  other->begin("b", "run");
  EXPECT_TRUE(one->record("a", {{1, amount(10, 1)}}));
  EXPECT_TRUE(other->record("b", {{1, amount(5, 2)}}));
  EXPECT_EQ(cut_of(*one, 1), amount(15, 3));
  EXPECT_TRUE(other->end("b"));
  EXPECT_TRUE(one->recover("a", "run", {{1, amount(20, 2)}}));
  EXPECT_EQ(cut_of(*other, 1), amount(25, 4));
}

TEST_F(ToolRecordsTest, of_a_killed_process_have_its_last_report) {
  const pid_t child = fork();
  if (child == 0) {
    const auto records = ToolRecords::open(file());
    (*records)->begin("m", "run");
    for (int i = 1; i <= 100; ++i) (*records)->record("m", {{1, amount(i, i)}});
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(cut_of(*open(), 1), amount(100, 100));
}

TEST_F(ToolRecordsTest, of_another_file_are_refused) {
  std::ofstream(file()) << "not a database, and longer than the head of one would be, which has a hundred bytes or so";
  const auto opened = ToolRecords::open(file());
  ASSERT_FALSE(opened.has_value());
  EXPECT_THAT(opened.error(), HasSubstr(file()));
}

TEST_F(ToolRecordsTest, are_written_by_a_recorder_each_second) {
  const auto records = open();
  CutRecorder recorder(*records, "m");
  request::Start start{.program = ProgramReader::from_text("t", ""), .options = {}};
  int seen = 0;
  start.watchers.motion = [&seen](const MotionItem&) { ++seen; };
  recorder.begin(start, "run");
  Action change{.kind = Action::Kind::tool_change, .tool = 2};
  change.outputs.spindle = SpindleDirection::clockwise;
  start.watchers.motion(change);
  PlannedMove move;
  Point end;
  end[Axis::x] = 10;
  move.begin_on({.curve = Curve::line(Point(), end)});
  move.add({.duration = Seconds(4)});
  move.to = Mm(10);
  start.watchers.motion(move);
  EXPECT_EQ(seen, 2) << "other observers go on";
  EXPECT_EQ(cut_of(*records, 2), CutAmount());
  recorder.poll(5);
  EXPECT_EQ(cut_of(*records, 2), amount(10, 4));
  start.watchers.motion(move);
  recorder.poll(5.5);
  EXPECT_EQ(cut_of(*records, 2), amount(10, 4)) << "not each turn";
  EXPECT_TRUE(recorder.end());
  EXPECT_EQ(cut_of(*records, 2), amount(20, 8));
  EXPECT_FALSE(records->open_run("m", "run"));
}

}  // namespace
}  // namespace passo
