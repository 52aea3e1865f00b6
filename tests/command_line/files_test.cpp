// The files of a command line: what is read is not overwritten, and one output does not overwrite another.
#include <filesystem>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

class FilesOfACommand : public passo::test::CommandLine {
 protected:
  FilesOfACommand() {
    program_ = write("p.ngc", text_);
    machine_ = write("m.toml", read(std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml"));
    run_ = "run -q " + program_ + " -m " + machine_ + " ";
  }
  void expect_refused(const std::string& command) const {
    const Outcome refused = passo(command);
    EXPECT_EQ(refused.code, 2) << command;
    EXPECT_THAT(refused.err, HasSubstr("it is the same file as")) << command;
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(read(program_), text_);
    EXPECT_TRUE(read(machine_).starts_with("#") || read(machine_).starts_with("name"));
  }

  std::string text_ = "G21 G0 X1\nM2\n";
  std::string program_;
  std::string machine_;
  std::string run_;
};

TEST_F(FilesOfACommand, that_are_read_are_not_overwritten) {
  expect_refused(run_ + "-r " + program_);
  expect_refused(run_ + "-r " + path("./../" + dir_.filename().string() + "/p.ngc"));
  expect_refused(run_ + "-r " + machine_);
  std::filesystem::create_symlink(program_, path("link.json"));
  expect_refused(run_ + "-r " + path("link.json"));
  std::filesystem::create_hard_link(program_, path("hard.csv"));
  expect_refused(run_ + "-t " + path("hard.csv"));
  expect_refused(run_ + "--tools " + write("t.tbl", "T1 P1 Z0.5 D3\n") + " -r " + path("t.tbl"));
  expect_refused(run_ + "--board tcp:127.0.0.1:1 --journal " + program_);
  expect_refused("canon " + program_ + " -o " + program_);
  expect_refused("canon - -o " + program_ + " <" + program_);
}

TEST_F(FilesOfACommand, a_machine_file_is_made_from_another_controllers_settings) {
  const std::string settings =
      write("settings.txt", "$0=5\n$100=250.000\n$110=6000.000\n$120=10.000\n$130=200.000\nok\n");
  const Outcome piped = passo("machine --from " + settings);
  EXPECT_EQ(piped.code, 0) << piped.err;
  EXPECT_THAT(piped.out, HasSubstr("max_velocity_mm_s = 100"));
  EXPECT_THAT(piped.err, HasSubstr("$110 = 6000.000 -> axis.X.max_velocity_mm_s = 100"));
  const Outcome written = passo("machine --from " + settings + " -o " + path("made.toml"));
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(read(path("made.toml")), piped.out);
  EXPECT_THAT(passo("machine " + path("made.toml")).out, HasSubstr("Grbl machine"));
  const auto json = nlohmann::json::parse(passo("machine --json --from " + settings).out);
  EXPECT_EQ(json.at("machine_file"), piped.out);
  EXPECT_EQ(json.at("format"), "settings");
  EXPECT_EQ(json.at("assumed").size(), 3U);

  EXPECT_EQ(passo("machine --from " + settings + " -o " + settings).code, 2);
  const Outcome wrong = passo("machine --format mach3 --from " + settings);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("settings.txt:1:1: error: this is not XML"));
  EXPECT_EQ(passo("machine --format marlin --from " + settings).code, 2);
  EXPECT_EQ(passo("machine --from " + path("none.ini")).code, 2);
  EXPECT_EQ(passo("machine").code, 2);
  EXPECT_EQ(passo("machine --json " + machine_).code, 2);
}

TEST_F(FilesOfACommand, that_a_program_may_call_are_not_overwritten) {
  const std::string sub = write("s.ngc", "o<s> sub\nG1 X2 F600\no<s> endsub\nM2\n");
  std::filesystem::create_directory(path("subs"));
  std::filesystem::copy(sub, path("subs/t.ngc"));
  for (const std::string& called : {sub, path("subs/t.ngc")}) {
    const std::string before = read(called);
    const Outcome refused = passo(run_ + "--subs " + path("subs") + " -r " + called);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("would overwrite a program that other programs may call"));
    EXPECT_EQ(read(called), before);
  }
}

TEST_F(FilesOfACommand, of_which_two_are_written_under_one_name_are_refused) {
  expect_refused(run_ + "-p " + path("a.svg") + " -p " + path("a.svg"));
  expect_refused(run_ + "-p " + path("a.svg") + " -r " + path("./a.svg"));
  expect_refused("chords --curve line --from 0,0 --to 3,4 --picture " + path("a.svg") + " -o " + path("a.svg"));
  for (const char* const other : {"./a.svg", "$PWD/a.svg"}) {
    const Outcome refused = passo(run_ + "-p a.svg -r " + std::string(other), "cd " + dir_.string() + " &&");
    EXPECT_EQ(refused.code, 2) << other;
    EXPECT_THAT(refused.err, HasSubstr("it is the same file as --picture")) << other;
  }
  EXPECT_EQ(files().size(), 0U);
}

TEST_F(FilesOfACommand, may_be_devices_and_the_same_as_yesterday) {
  EXPECT_EQ(passo(run_ + "-r /dev/null").code, 0);
  EXPECT_EQ(passo(run_ + "-r " + path("r.txt") + " -p " + path("a.svg")).code, 0);
  EXPECT_EQ(passo(run_ + "-r " + path("r.txt") + " -p " + path("a.svg")).code, 0);
}

// head and its like have seen enough: a run ends well and says nothing.
TEST_F(FilesOfACommand, end_quietly_where_nobody_reads_them) {
  const std::string line = "(" PASSO_PROGRAM " run --json " + program_ + " -m " + machine_ + " -r " + path("r.txt") +
                           " 2>" + path("said") + "; echo $? >" + path("code") + ") | true";
  EXPECT_EQ(std::system(line.c_str()), 0);
  EXPECT_THAT(read(path("code")), testing::AnyOf("0\n", "141\n"));
  EXPECT_EQ(read(path("said")), "");
  EXPECT_FALSE(read(path("r.txt")).empty());
}

}  // namespace
