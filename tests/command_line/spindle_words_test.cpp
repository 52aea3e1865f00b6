// What a user is told of threads that the machine cannot cut, of a spindle that runs up, and of a program for a laser.
#include <string>

#include "kit/command_line.hpp"
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using passo::test::Outcome;
using passo::test::read;

class SpindleWords : public passo::test::CommandLine {
 protected:
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  // X and Z, or X, Y and Z; 100 mm/s each. `spindle`: the content of the table [spindle].
  std::string machine(const std::string& spindle, bool has_y = false) const {
    std::string text =
        "name = \"m\"\n[board]\nclock_hz = 160_000_000\nmax_event_rate_hz = 5_000_000\nstep_pulse_us = 0.1\n"
        "[tool]\nmax_rpm = 6000\n[spindle]\n" +
        spindle + "\n";
    for (const char* axis : {"X", "Y", "Z"}) {
      if (*axis == 'Y' && !has_y) continue;
      text += "[axis." + std::string(axis) +
              "]\nsteps_per_mm = 4000\ntravel_mm = [-1000, 1000]\nmax_velocity_mm_s = 100\n"
              "max_acceleration_mm_s2 = 500\n";
    }
    return write("m.toml", text);
  }
  Outcome check(const std::string& program, const std::string& machine_file) const {
    return passo("check " + write("p.ngc", program) + " -m " + machine_file);
  }
  double time_of(const std::string& program, const std::string& machine_file) const {
    const Outcome outcome = passo("run " + write("p.ngc", program) + " --json -m " + machine_file);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["time_s"];
  }
};

TEST_F(SpindleWords, a_thread_that_an_axis_cannot_follow_is_refused_by_check_and_run) {
  const std::string lathe = machine("encoder_counts_per_turn = 400\nrun_up_s = 0.5");
  for (const char* const thread :
       {"G33 Z-15 K4", "G33.1 Z-15 K4", "G76 P4 Z-15 I-1 J0.2 K0.9 R1.5 H2", "G95 G1 F4 Z-15"}) {
    const std::string program = "G21 G18 G90\nM3 S6000\nG0 X12 Z5\n" + std::string(thread) + "\nG94\nM5\nM2\n";
    const Outcome checked = check(program, lathe);
    EXPECT_EQ(checked.code, 2) << thread << checked.err;
    EXPECT_TRUE(contains(checked.err, "p.ngc:4:")) << checked.err;
    EXPECT_TRUE(contains(checked.err, "Z would have to move at 400.0 mm/s, above its limit of 100")) << checked.err;
    EXPECT_TRUE(contains(checked.err, "S up to 1500, or up to 1.000 mm/rev")) << checked.err;
    const Outcome run = passo("run --yes " + path("p.ngc") + " -m " + lathe);
    EXPECT_EQ(run.code, 2) << thread;
    EXPECT_TRUE(contains(run.err, "[path.thread-too-fast]")) << run.err;
  }
}

TEST_F(SpindleWords, the_thread_of_the_collection_is_refused) {
  const fs::path cases = fs::path(PASSO_SOURCE_DIR) / "../shared/cases/motion";
  if (!fs::exists(cases / "pitch.ngc")) GTEST_SKIP() << "no ../shared/cases beside this checkout";
  const Outcome checked = passo("check " + (cases / "pitch.ngc").string() + " -m " + (cases / "lathe.toml").string());
  EXPECT_EQ(checked.code, 2);
  EXPECT_TRUE(contains(checked.err, "pitch.ngc:5:")) << checked.err;
  EXPECT_TRUE(contains(checked.err, "400.0 mm/s, above its limit of 100")) << checked.err;
}

TEST_F(SpindleWords, the_time_to_run_up_is_part_of_the_time) {
  const std::string program = "G21 G90\nM3 S6000\nG1 X10 F600\nS2000\nG1 X20\nM3\nG1 X30\nM5\nG0 X0\nM2\n";
  EXPECT_NEAR(time_of(program, machine("run_up_s = 0.5", true)), time_of(program, machine("run_up_s = 0", true)) + 5,
              0.1)
      << "0.5 s for each of 6000 and 4000 turns a minute, and none for M3 at the same speed";
  const std::string dwells = "G21 G90\nM3 S6000\nG4 P2\nG1 X10 F600\nM5\nM2\n";
  EXPECT_NEAR(time_of(dwells, machine("run_up_s = 0.5", true)), time_of(dwells, machine("run_up_s = 0", true)) + 1,
              0.01);
}

TEST_F(SpindleWords, a_cut_directly_after_m3_is_warned_of_where_nothing_waits) {
  const std::string unknown = machine("", true);
  const Outcome early = check("G21 G90\nG0 Z5\nM3 S5000\nG0 X10\nG1 Z-1 F60\nG0 Z5\nM5\nM2\n", unknown);
  EXPECT_EQ(early.code, 0);
  EXPECT_TRUE(contains(early.err, "p.ngc:3:1: warning: a cut follows at once")) << early.err;
  EXPECT_TRUE(contains(early.err, "[path.spindle-early]")) << early.err;
  const auto is_warned = [&](const std::string& program, const std::string& file) {
    return contains(check(program, file).err, "path.spindle-early");
  };
  const std::string dwells = "G21 G90\nM3 S5000\nG4 P2\nG0 X10\nG1 Z-1 F60\nM5\nM2\n";
  EXPECT_FALSE(is_warned(dwells, unknown));
  EXPECT_FALSE(is_warned("G21 G90\nM3 S5000\nG0 X10\nM5\nM2\n", unknown)) << "nothing is cut";
  EXPECT_FALSE(is_warned("G21 G90\nM3 S5000\nG1 F600\nG4 P2\nG1 Z-1\nM5\nM2\n", unknown)) << "F alone moves nothing";
  EXPECT_TRUE(is_warned("G21 G90\nM3 S2000\nG4 P2\nG1 Z-1 F60\nG0 Z5\nS5000\nG0 X9\nG1 Z-1\nM5\nM2\n", unknown)) << "S";
  EXPECT_FALSE(is_warned("G21 G90\nM3 S5000\nG4 P2\nG1 Z-1 F60\nG0 Z5\nS2000\nG1 X9\nM5\nM2\n", unknown)) << "slower";
  EXPECT_FALSE(is_warned("G21 G90\nM3 S500\nG4 P2\nG84 R2 Z-9 F500\nG80\nM5\nM2\n", unknown)) << "a tap is reversed";
  const std::string program = "G21 G90\nM3 S5000\nG1 Z-1 F60\nM5\nM2\n";
  EXPECT_TRUE(is_warned(program, unknown));
  EXPECT_FALSE(is_warned(program, machine("run_up_s = 0.1", true)));
  EXPECT_FALSE(is_warned(program, machine("run_up_s = 0", true)));
}

TEST_F(SpindleWords, a_program_for_a_laser_is_warned_of_with_its_places) {
  const std::string mill = machine("run_up_s = 0", true);
  const Outcome lines =
      check("G21 G91 F4000\nM3 S1\nG1 X1 S100\nG1 X1 S0\nG0 X1\nG1 X1 S100\nG1 X1 S0\nM5\nM2\n", mill);
  EXPECT_EQ(lines.code, 0);
  EXPECT_TRUE(contains(lines.err, "p.ngc:3:1: warning: S changes in 4 feeds, as in")) << lines.err;
  EXPECT_TRUE(contains(lines.err, "= and 3 more, lines 4, 6, 7\n")) << lines.err;
  EXPECT_TRUE(contains(lines.err, "without [laser] in the machine file")) << lines.err;
  EXPECT_TRUE(contains(lines.err, "[path.laser]")) << lines.err;
  const Outcome backwards = check("G21 G91 F4000\nM4 S100\nG1 X1\nG1 X1 S50\nM5\nM2\n", mill);
  EXPECT_TRUE(contains(backwards.err, "S changes, or M4 is on in 2 feeds, as in")) << backwards.err;
  EXPECT_TRUE(contains(backwards.err, "= and 1 more, line 4\n")) << backwards.err;
  EXPECT_TRUE(contains(check("G21 G91 F4000\nM4 S100\nG1 X1\nM5\nM2\n", mill).err,
                       "p.ngc:3:1: warning: M4 is on in 1 feed, as in"));
  const auto is_warned = [&](const std::string& program, const std::string& file) {
    return contains(check(program, file).err, "path.laser");
  };
  EXPECT_FALSE(is_warned("G21 G91 F600\nM3 S1000\nG1 X1\nG0 Z5\nS2000\nG1 X1\nM5\nM2\n", mill)) << "between cuts";
  EXPECT_FALSE(is_warned("G21 G91 F600\nM3 S1000\nG1 X1\nS2000\nG4 P1\nG1 X1\nM5\nM2\n", mill)) << "with a dwell";
  EXPECT_FALSE(is_warned("G21 G90\nM4 S500\nG74 R2 Z-9 F500\nG80\nM5\nM2\n", mill)) << "a left-hand tap";
  EXPECT_FALSE(is_warned("G21 G91 F600\nM4 S100\nG1 X1 S200\nG1 X1 S50\nM5\nM2\n", machine("run_up_s = 0")))
      << "a lathe";
}

TEST_F(SpindleWords, the_laser_program_of_the_collection_is_warned_of) {
  const fs::path program = fs::path(PASSO_SOURCE_DIR) / "../shared/cases/language/s-per-move.ngc";
  if (!fs::exists(program)) GTEST_SKIP() << "no ../shared/cases beside this checkout";
  const Outcome checked = passo("check " + program.string() + " -m " + machine("", true));
  EXPECT_EQ(checked.code, 0);
  EXPECT_TRUE(contains(checked.err, "in 300 feeds, as in")) << checked.err;
  EXPECT_TRUE(contains(checked.err, "= and 299 more, lines 3, 4, 5, ...")) << checked.err;
}

}  // namespace
