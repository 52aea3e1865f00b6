#include "passo/report/signals_reader.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <unistd.h>

namespace passo {
namespace {

class SignalsReader : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder_);
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  static SignalsToRead all() {
    return {.wanted = [](std::string_view) { return true; }, .most_changes = 100};
  }
  // The changes of a signal as "at:level at:level".
  static std::string changes(const Signals& signals, const std::string& name) {
    std::string text;
    for (const Signal& signal : signals.signals) {
      if (signal.name != name) continue;
      for (const SignalChange& change : signal.changes) {
        text += (text.empty() ? "" : " ") + std::to_string(change.at) + (change.high ? ":1" : ":0");
      }
    }
    return text;
  }
  // The error, without the folder.
  std::string error_of(const std::string& name, const std::string& text, const SignalsToRead& what = all()) const {
    const auto signals = read_signals(write(name, text), what);
    if (signals) return "no error";
    const std::string folder = folder_.string() + "/";
    return signals.error().starts_with(folder) ? signals.error().substr(folder.size()) : signals.error();
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("passo-signals-reader-" + std::to_string(::getpid()));
};

constexpr const char* header =
    "$timescale 10 ns $end\n$scope module m $end\n$var wire 1 ! X_step $end\n"
    "$var wire 1 \" X_dir $end\n$var wire 16 # rpm [15:0] $end\n$upscope $end\n"
    "$enddefinitions $end\n";

TEST_F(SignalsReader, reads_waves_in_nanoseconds) {
  const auto signals = read_signals(
      write("a.vcd", std::string("$date today $end $version V $end\n") + header +
                         "#0\n$dumpvars\n0!\nx\"\nb0000000000000001 #\n$end\n#5 1! 1\"\r\n#7\n0!\n#9\nz\"\n#20\n"),
      all());
  ASSERT_TRUE(signals) << signals.error();
  EXPECT_EQ(changes(*signals, "X_step"), "50:1 70:0");
  EXPECT_EQ(changes(*signals, "X_dir"), "50:1 90:0");
  EXPECT_EQ(signals->signals.size(), 2U);
  EXPECT_EQ(signals->end, 200);
}

TEST_F(SignalsReader, reads_picoseconds_and_two_names_of_one_code) {
  const auto signals = read_signals(write("a.vcd",
                                          "$timescale 100ps $end $var reg 1 a D0 $end $var wire 1 a copy $end\n"
                                          "$enddefinitions $end #0 0a #12345 1a"),
                                    all());
  ASSERT_TRUE(signals) << signals.error();
  EXPECT_EQ(changes(*signals, "D0"), "1234:1");
  EXPECT_EQ(changes(*signals, "copy"), "1234:1");
}

TEST_F(SignalsReader, stops_at_the_end_that_it_was_given_and_leaves_out_what_is_not_wanted) {
  SignalsToRead what = all();
  what.until = 60;
  what.wanted = [](std::string_view name) { return name == "X_step"; };
  const auto signals = read_signals(write("a.vcd", std::string(header) + "#0\n1\"\n#5\n1!\n#7\n0!\nrubbish"), what);
  ASSERT_TRUE(signals) << signals.error();
  EXPECT_EQ(changes(*signals, "X_step"), "50:1");
  EXPECT_EQ(changes(*signals, "X_dir"), "");
  EXPECT_EQ(signals->end, 60);
}

TEST_F(SignalsReader, names_the_line_and_what_it_expected_in_waves) {
  using testing::StartsWith;
  EXPECT_THAT(error_of("a.vcd", std::string(header) + "#5\n1?\n"),
              StartsWith("a.vcd:9: expected the code of a signal from the header, got '?'"));
  EXPECT_THAT(error_of("a.vcd", std::string(header) + "#5\n#4\n"),
              StartsWith("a.vcd:9: expected a time that is not before the last one, got '#4'"));
  EXPECT_THAT(error_of("a.vcd", std::string(header) + "hello\n"), StartsWith("a.vcd:8: expected #TIME, or 0 or 1"));
  EXPECT_THAT(error_of("a.vcd", std::string(header) + "#1x\n"), StartsWith("a.vcd:8: expected #TIME, got '#1x'"));
  EXPECT_THAT(error_of("a.vcd", "$timescale 3 ns $end\n"), StartsWith("a.vcd:1: expected a $timescale such as 1 ns"));
  EXPECT_THAT(error_of("a.vcd", "$var wire 1 !\n"), StartsWith("a.vcd:1: the file ends; expected $end after $var"));
  EXPECT_THAT(error_of("a.vcd", "$enddefinitions $end\n"), StartsWith("a.vcd:1: expected a $timescale"));
  EXPECT_THAT(error_of("a.vcd", "t,x,y\n0,1,1\n"), StartsWith("a.vcd:1: expected a command of a VCD's header"));
  EXPECT_THAT(error_of("a.vcd", ""), StartsWith("a.vcd:1: the file ends; expected $enddefinitions"));
  SignalsToRead few = all();
  few.most_changes = 1;
  EXPECT_THAT(error_of("a.vcd", std::string(header) + "#5\n1!\n#6\n0!\n", few),
              StartsWith("a.vcd:11: expected at most 1 changes of the signals in use; there are more after"));
  EXPECT_THAT(read_signals("/nowhere/a.vcd", all()).error(), StartsWith("cannot read /nowhere/a.vcd: No such file"));
}

TEST_F(SignalsReader, reads_levels_from_a_table) {
  const auto signals =
      read_signals(write("a.csv", "; of an analyser\nt,clock_x,key_5\n0,0,1\n0.000001500,1,1\r\n\n2e-6,0,0\n"), all());
  ASSERT_TRUE(signals) << signals.error();
  EXPECT_EQ(changes(*signals, "clock_x"), "1500:1 2000:0");
  EXPECT_EQ(changes(*signals, "key_5"), "0:1 2000:0");
}

// Steps become pulses, which end halfway to the next step of the same motor.
TEST_F(SignalsReader, reads_steps_from_the_trace_of_a_run) {
  const auto signals = read_signals(write("a.csv", "t,x,y\n0.001,1,0\n0.0012,-1,1\n0.0016,-1,0\n1.0,0,1\n"), all());
  ASSERT_TRUE(signals) << signals.error();
  EXPECT_EQ(changes(*signals, "x_step"), "1000000:1 1100000:0 1200000:1 1400000:0 1600000:1 2600000:0");
  EXPECT_EQ(changes(*signals, "x_dir"), "1200000:1");
  EXPECT_EQ(changes(*signals, "y_step"), "1200000:1 2200000:0 1000000000:1 1001000000:0");
}

TEST_F(SignalsReader, names_the_line_and_what_it_expected_in_tables) {
  using testing::StartsWith;
  EXPECT_THAT(error_of("a.csv", "x,y\n1,1\n"), StartsWith("a.csv:1: expected the names of the columns, the time in"));
  EXPECT_THAT(error_of("a.csv", ""), StartsWith("a.csv:1: expected the names of the columns"));
  EXPECT_THAT(error_of("a.csv", "t,x\n0,1,1\n"), StartsWith("a.csv:2: expected 2 columns, as in the first row, got 3"));
  EXPECT_THAT(error_of("a.csv", "t,x\n-1,1\n"), StartsWith("a.csv:2: expected a time in seconds, 0 to 1e6, got '-1'"));
  EXPECT_THAT(error_of("a.csv", "t,x\n1,1\n0.5,1\n"), StartsWith("a.csv:3: expected a time that is not before"));
  EXPECT_THAT(error_of("a.csv", "t,x\n1,2\n"), StartsWith("a.csv:2: expected a step, -1, 0 or 1, got '2'"));
  EXPECT_THAT(error_of("a.csv", "t,clock_x\n1,-1\n"), StartsWith("a.csv:2: expected a level, 0 or 1, got '-1'"));
}

// What write_signals wrote comes back.
TEST_F(SignalsReader, reads_what_passo_writes) {
  const Signals signals{.title = "board",
                        .signals = {{"clock_x", {{0, true}, {1'500'000, false}}}, {"relay", {{1'500'000, true}}}},
                        .end = 3'000'000};
  for (const char* name : {"b.vcd", "b.csv"}) {
    const std::string path = write(name, "");
    auto file = OutputFile::open(path);
    ASSERT_TRUE(file);
    (path.ends_with(".vcd") ? write_signals_vcd : write_signals_csv)(signals, *file);
    ASSERT_TRUE(file->commit());
    const auto read = read_signals(path, all());
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(changes(*read, "clock_x"), "0:1 1500000:0");
    EXPECT_EQ(changes(*read, "relay"), "1500000:1");
  }
}

}  // namespace
}  // namespace passo
