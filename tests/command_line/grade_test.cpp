// passo grade, as a teacher starts it.
#include <filesystem>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using passo::test::lacks_an_emulator;
using passo::test::Outcome;
using passo::test::read;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Right for two motors that go equally far, and for no others.
const std::string diagonal =
    "#!/bin/sh\nprintf 'Motor 1? '; read x; printf 'Motor 2? '; read y\n"
    "i=0; while [ $i -lt $x ]; do i=$((i+1)); echo \"$i $i\"; done\n";

class Grading : public passo::test::CommandLine {
 protected:
  Outcome lines(const std::string& arguments) const { return passo("grade lines " + arguments); }
  static bool lacks_confinement(const Outcome& outcome) {
    return outcome.code == 1 && outcome.err.find("--unconfined runs programs") != std::string::npos;
  }
};

TEST_F(Grading, names_the_first_wrong_pulse_of_each_move) {
  const Outcome graded = lines(write("anna", diagonal));
  if (lacks_confinement(graded)) GTEST_SKIP() << graded.err;
  EXPECT_EQ(graded.code, 0) << graded.err;
  EXPECT_THAT(graded.out, testing::StartsWith("anna: 3 of 19 (16 %)\n  it asks for 2 motors;"));
  EXPECT_THAT(graded.out, HasSubstr("\n  move (10, 4), pulse 1: expected 1 0, found 1 1; motor 2: 1 * 4 / 10 = 0.4\n"));
  EXPECT_THAT(graded.out, HasSubstr("\n  move (0, 9): no positions found in its output\n"));
  EXPECT_THAT(graded.out, Not(HasSubstr("move (12, 12)")));
}

TEST_F(Grading, runs_a_command_line) {
  const std::string file = write("anna.txt", diagonal);
  const Outcome graded = lines("'sh " + file + "' --motors 2 --json");
  if (lacks_confinement(graded)) GTEST_SKIP() << graded.err;
  ASSERT_EQ(graded.code, 0) << graded.err;
  const nlohmann::json student = nlohmann::json::parse(graded.out)["students"][0];
  EXPECT_EQ(student["program"], "sh ./anna.txt");
  EXPECT_EQ(student["right"], 3);
  EXPECT_EQ(student["played"][0]["pulse"], 1);
  EXPECT_EQ(student["played"][0]["expected"], "1 0");
}

TEST_F(Grading, writes_a_table_and_a_page_of_a_class) {
  fs::create_directories(path("class/carla"));
  write("class/=anna<b>.sh", diagonal);
  write("class/carla/lines", "#!/bin/sh\nprintf '\\033[2J\\377oops' >&2; exit 3\n");
  write("class/dino.txt", "text");
  const Outcome graded = lines(path("class") + " --csv " + path("m.csv") + " --report " + path("m.html"));
  if (lacks_confinement(graded)) GTEST_SKIP() << graded.err;
  EXPECT_EQ(graded.code, 0) << graded.err;
  EXPECT_THAT(graded.out, HasSubstr("carla: 0 of 19 (0 %)\n"));
  EXPECT_THAT(graded.out, HasSubstr("it ended with exit code 3; it says:  [2J\uFFFDoops"));
  EXPECT_THAT(graded.err, HasSubstr("--run 'python3 {}'"));
  const std::string csv = read(path("m.csv"));
  // No spreadsheet calculates a student's name.
  EXPECT_THAT(csv, HasSubstr("\n'=anna<b>,./=anna<b>.sh,3,19,15.8,\"move (10, 4), pulse 1: expected 1 0, found 1 1;"));
  EXPECT_THAT(csv, HasSubstr("\ndino,,0,19,0.0,"));
  const std::string page = read(path("m.html"));
  EXPECT_THAT(page, AllOf(HasSubstr("=anna&lt;b&gt;"), Not(HasSubstr("<b>")), Not(HasSubstr("<script"))));
  EXPECT_THAT(page, HasSubstr("<dt>mean mark</dt><dd>5 %</dd>"));
}

TEST_F(Grading, stops_at_once_by_ctrl_c_and_leaves_nothing) {
  fs::create_directories(path("temporary"));
  const std::string waits = write("anna", "#!/bin/sh\nkill -STOP $$\n");
  // In the foreground it sends one signal; otherwise two, and a second one ends the command as it stands.
  const std::string interrupted =
      "TMPDIR=" + path("temporary") + " timeout --foreground --preserve-status --signal=INT 0.5";
  const Outcome stopped = passo("grade lines " + waits + " --csv " + path("m.csv"), interrupted);
  if (lacks_confinement(stopped)) GTEST_SKIP() << stopped.err;
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  EXPECT_TRUE(fs::is_empty(path("temporary")));
  EXPECT_FALSE(fs::exists(path("m.csv")));
}

TEST_F(Grading, refuses_in_words_what_it_cannot_grade) {
  const auto refused = [&](const std::string& arguments) {
    const Outcome outcome = passo("grade " + arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    return outcome.err;
  };
  EXPECT_THAT(refused("lines " + path("nobody")), HasSubstr("nobody: expected a program, a command line in quotes"));
  fs::create_directories(path("empty"));
  EXPECT_THAT(refused("lines " + path("empty")), HasSubstr("expected a file or a folder for each student"));
  EXPECT_THAT(refused("lines " + write("anna", diagonal) + " --report marks.pdf"), HasSubstr("must end with .html"));
  EXPECT_THAT(refused("lines anna --motors 9"), HasSubstr("--motors"));
  EXPECT_THAT(refused("board " + path("nobody.hex")), HasSubstr("there is no such file or folder"));
  EXPECT_THAT(refused("board " + path("nobody.hex") + " --board uno"), HasSubstr("--board"));
}

// The follower's own images are right; on the pins of the other board they are not.
TEST_F(Grading, plays_the_vectors_to_programs_for_the_pic) {
  const std::string images = (fs::path(PASSO_PROGRAM).parent_path() / "src" / "board" / "chip").string();
  if (!fs::exists(images + "/first_board.hex")) GTEST_SKIP() << "the images of the PIC are not built";
  const Outcome first = passo("grade board " + images + "/first_board.hex");
  if (lacks_an_emulator(first)) GTEST_SKIP() << first.err;
  EXPECT_THAT(first.out, HasSubstr("(100 %)")) << first.out << first.err;
  fs::create_directories(path("class/anna"));
  fs::copy_file(images + "/follower_pic_wave.hex", path("class/anna/Board.HEX"));
  write("class/bruno.hex", ":00000001FF\n");
  write("class/carla.hex", "none\n");
  write("class/notes.txt", "none\n");
  const Outcome graded = passo("grade board " + path("class") + " --board pic_wave --csv " + path("m.csv"));
  EXPECT_EQ(graded.code, 0) << graded.err;
  EXPECT_EQ(read(path("m.csv")),
            "student,program,right,cases,mark_percent,first_fault,remark\n"
            "anna,Board.HEX,1,1,100.0,,\n"
            "bruno,bruno.hex,0,1,0.0,wave: it is not firmware for a PIC16F877A: it never writes to a port,\n"
            "carla,,0,1,0.0,carla.hex is not an Intel HEX file: line 1: it does not begin with ':',\n");
  const Outcome wrong = passo("grade board " + path("class/anna/Board.HEX") + " --board pic_half_step --json");
  const nlohmann::json fault = nlohmann::json::parse(wrong.out)["students"][0]["played"][0];
  EXPECT_EQ(fault["right"], false);
  EXPECT_THAT(fault["output"].get<std::string>(), testing::StartsWith("windings."));
  EXPECT_GT(fault["time_s"], 0);
}

}  // namespace
