// Whole programs: what they get, where they run, and what is said of them.
#include "passo/grading/line_grading.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "passo/confinement/confinement.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Programs in the system's shell. Lean interpolation, for the motors that are named.
std::string two_motors(const std::string& before_loop = "") {
  return "#!/bin/sh\nread x; read y\n" + before_loop +
         "m=$x; [ $y -gt $m ] && m=$y\n"
         "dx=$((-m)); dy=$((-m)); px=0; py=0; i=0\n"
         "while [ $i -lt $m ]; do\n"
         "  dx=$((dx+2*x)); [ $dx -ge 0 ] && px=$((px+1)) && dx=$((dx-2*m))\n"
         "  dy=$((dy+2*y)); [ $dy -ge 0 ] && py=$((py+1)) && dy=$((dy-2*m))\n"
         "  echo \"$px\t$py\"; i=$((i+1))\n"
         "done\n";
}

class LineGrader : public testing::Test {
 protected:
  LineGrader() { fs::create_directories(dir_); }
  ~LineGrader() override { fs::remove_all(dir_); }
  void SetUp() override {
    const Status<std::string> can = check_confinement();
    if (!can) GTEST_SKIP() << can.error();
  }

  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((dir_ / name).parent_path());
    std::ofstream(dir_ / name) << text;
    return dir_ / name;
  }
  static Grade grade(const Submission& submission, const LineGrading& grading = quick()) {
    const Result<Grade, std::string> done = grade_lines(submission, grading);
    EXPECT_TRUE(done) << (done ? "" : done.error());
    return done ? *done : Grade{};
  }
  static LineGrading quick() {
    LineGrading grading;
    grading.limits = {.processor_seconds = 2, .waiting_seconds = 1, .total_seconds = 10};
    return grading;
  }

  fs::path dir_ = fs::temp_directory_path() / ("passo-grading-" + std::to_string(getpid()));
};

TEST_F(LineGrader, gives_full_marks_to_a_program_of_two_motors) {
  const Grade done = grade({"anna", write("anna.sh", two_motors())});
  EXPECT_EQ(done.first_fault(), "");
  EXPECT_EQ(done.cases, 19U);
  EXPECT_EQ(done.right(), 19U);
  EXPECT_EQ(done.mark(), 100);
  EXPECT_EQ(done.program, "./anna.sh");
  EXPECT_EQ(done.remark, "it asks for 2 motors; moves of more were not played");
}

TEST_F(LineGrader, names_the_first_wrong_pulse_of_a_program) {
  const Grade done = grade({"bruno", write("bruno", two_motors("[ $x -eq 8 ] && y=4\n"))});
  EXPECT_EQ(done.right(), 18U);
  EXPECT_EQ(done.first_fault(), "move (8, 5), pulse 4: expected 4 3, found 4 2; motor 2: 4 * 5 / 8 = 2.5");
}

TEST_F(LineGrader, asks_for_as_many_motors_as_the_teacher_wants) {
  LineGrading three = quick();
  three.motors = 3;
  const Grade done = grade({"anna", write("anna", two_motors())}, three);
  EXPECT_EQ(done.cases, 26U);
  EXPECT_EQ(done.right(), 0U);
}

TEST_F(LineGrader, runs_each_case_with_a_fresh_copy_of_a_folder) {
  write("carla/lines", two_motors(". ./start; echo x >>start\n"));
  write("carla/start", "echo 'Hello'\n");
  write("carla/data/numbers", "1\n");
  const Grade done = grade({"carla", dir_ / "carla"});
  EXPECT_EQ(done.first_fault(), "");
  write("carla/other", "#!/bin/sh\n");
  EXPECT_EQ(grade({"carla", dir_ / "carla"}).right(), 19U);  // the one that is named lines
  fs::rename(dir_ / "carla/lines", dir_ / "carla/mine");
  EXPECT_THAT(grade({"carla", dir_ / "carla"}).trouble, HasSubstr("the one to use must be named lines"));
}

TEST_F(LineGrader, runs_a_program_by_another_one) {
  const fs::path file = write("dino.txt", two_motors());
  fs::permissions(file, fs::perms::owner_read);
  EXPECT_EQ(grade({"dino", file, {"sh", "{}"}}).right(), 19U);
  const Grade missing = grade({"dino", file, {"no-such-program", "{}"}});
  EXPECT_EQ(missing.trouble, "no-such-program ./dino.txt cannot be started: No such file or directory");
  EXPECT_EQ(grade({"elena", write("elena.txt", "Sorry")}).trouble,
            "no program, that is, an executable or a script that begins with #!");
}

TEST_F(LineGrader, reports_what_ends_a_program_and_stops_asking_one_that_hangs) {
  const Grade crashed = grade({"fabio", write("fabio", two_motors("[ $x -eq 27 ] && kill -SEGV $$\n"))});
  EXPECT_EQ(crashed.right(), 18U);
  EXPECT_THAT(crashed.first_fault(), HasSubstr("move (27, 3): no positions found in its output; it crashed"));
  const Grade hung = grade({"gino", write("gino", "#!/bin/sh\nread x\nkill -STOP $$\n")});
  EXPECT_EQ(hung.right(), 0U);
  EXPECT_EQ(hung.played.size(), 1U);  // a trial came before
  EXPECT_EQ(hung.first_fault(), "move (10, 4): no positions found in its output; it waited without an end");
  EXPECT_EQ(hung.remark, "it was stopped 2 times; 18 cases were not played");
  const Grade complains = grade({"hugo", write("hugo", "#!/bin/sh\nno-such-command\nexit 3\n")});
  EXPECT_THAT(complains.first_fault(),
              testing::AllOf(HasSubstr("it ended with exit code 3"), HasSubstr("no-such-command: not found")));
}

TEST_F(LineGrader, gives_no_other_students_work_to_a_program) {
  write("class/anna", two_motors());
  write("class/bruno", "#!/bin/sh\n. " + (dir_ / "class/anna").string() + "\n");
  EXPECT_EQ(grade({"bruno", dir_ / "class/bruno"}).right(), 0U);
}

TEST(Dialogue, is_a_line_for_each_motor_and_an_empty_one) {
  EXPECT_EQ(dialogue_for({10, 4}, false), "10\n4\n\n");
  EXPECT_EQ(dialogue_for({10, 4, 6}, true), "3\n10\n4\n6\n\n");
}

TEST_F(LineGrader, finds_the_students_of_a_class) {
  write("class/zoe.sh", "");
  write("class/anna/lines", "");
  write("class/.hidden", "");
  write("class/max.py", "");
  write("class/max.c", "");
  std::vector<std::string> students;
  for (const Submission& one : submissions_in(dir_ / "class", "", {})) students.push_back(one.student);
  EXPECT_THAT(students, testing::ElementsAre("anna", "max.c", "max.py", "zoe"));
  write("class/max.HEX", "");
  EXPECT_EQ(submissions_in(dir_ / "class", ".hex", {}).size(), 2U);  // and anna's folder
  fs::create_symlink("/etc", dir_ / "class" / "link");
  EXPECT_EQ(grade({"link", dir_ / "class" / "link"}).trouble, "a link, not a file or a folder");
}

}  // namespace
}  // namespace passo
