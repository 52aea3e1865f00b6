// The page of `passo check` as a user sees it: time, ways and what the motors can do.
#include <cmath>
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

const std::string board = "name = \"checked\"\n[board]\nclock_hz = 16_000_000\nmax_event_rate_hz = 100_000\n";

std::string axis(const std::string& name, double acceleration) {
  return "[axis." + name +
         "]\nsteps_per_turn = 200\nmicrosteps = 8\nscrew_pitch_mm = 4\ntravel_mm = [-100, 100]\n"
         "max_velocity_mm_s = 50\nmax_acceleration_mm_s2 = " +
         std::to_string(acceleration) + "\n";
}

std::string with_motor(double acceleration, const std::string& more = "") {
  return board + axis("X", acceleration) +
         "[axis.X.torque]\nlimits_motion = false\nholding_torque_nm = 0.45\nrated_current_a = 1.7\n"
         "resistance_ohm = 1.5\ninductance_mh = 2.8\nsupply_v = 24\nrotor_inertia_g_cm2 = 68\nload_mass_kg = 200\n"
         "friction_n = 100\n" +
         more;
}

class CheckMargin : public passo::test::CommandLine {
 protected:
  Outcome check(double acceleration, const std::string& options = "", const std::string& more = "") const {
    return passo("check " + write("p.ngc", "G21 G90\nG0 X30\nG4 P2\nG1 X-30 F300\nG0 X0\nM2\n") + " -m " +
                 write("m.toml", with_motor(acceleration, more)) + " " + options);
  }
};

TEST_F(CheckMargin, of_a_gentle_machine_is_safe) {
  const Outcome outcome = check(100);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("0:00:14 in motion, 0:00:02 of dwells\n"));
  EXPECT_THAT(outcome.out, HasSubstr("-30.000 to 30.000 mm of -100 to 100"));
  EXPECT_THAT(outcome.out, HasSubstr("\nmotors          safe"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("doubtful:")));
}

TEST_F(CheckMargin, of_a_wild_machine_is_lost_with_cause_cure_and_code) {
  const Outcome outcome = check(4'000);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[check.steps-lost]"));
  EXPECT_THAT(outcome.out, HasSubstr("lost: X needs "));
  EXPECT_THAT(outcome.out, HasSubstr("a <= "));
}

TEST_F(CheckMargin, is_doubtful_where_only_a_strong_motor_does_it_and_passes) {
  const Outcome outcome = check(1'000, "--json", "tolerance = 0.3\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["good"], true);
  EXPECT_EQ(json["margin"]["verdict"], "doubtful");
  const auto& worst = json["margin"]["worst_lines"][0];
  EXPECT_EQ(worst["axis"], "X");
  EXPECT_GT(worst["line"], 1);
  EXPECT_LT(worst["low_nm"], worst["high_nm"]);
  EXPECT_LT(worst["safe_acceleration"], 1'000);
  EXPECT_NEAR(json["dwell_s"], 2, 1e-9);
  EXPECT_EQ(json["axes"]["X"]["extents"][1], 30);
}

// The extents on the machine are wider than those of the work.
TEST_F(CheckMargin, tells_a_turned_work_along_its_own_axes) {
  const std::string machine = board + axis("X", 500) + axis("Y", 500) + axis("Z", 500);
  const std::string program = write("p.ngc", "G21 G90 G61 G10 L2 P1 X7 R30\nG0 X0 Y0\nG1 X40 F600\nY20\nX0\nY0\nM2\n") +
                              " -m " + write("m.toml", machine);
  EXPECT_THAT(passo("check " + program).out,
              HasSubstr("\nG54             X 0.000 to 40.000 mm, Y 0.000 to 20.000 mm, Z 0.000 to 0.000 mm at feed\n"));
  const auto json = nlohmann::json::parse(passo("check --json " + program).out);
  EXPECT_NEAR(json["work"]["G54"]["Y"][1], 20, 1e-9);
  EXPECT_NEAR(json["axes"]["Y"]["extents"][1], 40 * 0.5 + 20 * std::sqrt(0.75), 1e-9);
}

TEST_F(CheckMargin, is_drawn_along_the_path) {
  const Outcome outcome = check(100, "--picture " + path("margin.svg") + " --colour-by margin");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(passo::test::read(path("margin.svg")), HasSubstr("<svg"));
  EXPECT_EQ(check(100, "--colour-by margin").code, 2);
  EXPECT_EQ(check(100, "--colour-by speed --picture " + path("speed.svg")).code, 2);
}

TEST_F(CheckMargin, is_written_for_each_line) {
  const Outcome outcome = check(100, "--loads " + path("loads.csv"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(passo::test::read(path("loads.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "line,load");
  int moving = 0;
  for (int before = 0; std::getline(lines, line); ++moving) {
    const std::size_t comma = line.find(',');
    ASSERT_NE(comma, std::string::npos) << line;
    EXPECT_GT(std::stoi(line), before) << "each line of the program once, in order";
    before = std::stoi(line);
    const double load = std::stod(line.substr(comma + 1));
    EXPECT_GT(load, 0) << line;
    EXPECT_LT(load, 1) << "this machine is safe: " << line;
  }
  EXPECT_GT(moving, 0);
  EXPECT_EQ(check(100, "--motion --loads " + path("loads.csv")).code, 2);
}

TEST_F(CheckMargin, agrees_with_the_physics_of_a_run) {
  for (const double acceleration : {100.0, 4'000.0}) {
    const Outcome verdict = check(acceleration);
    EXPECT_EQ(passo("run " + path("p.ngc") + " -m " + path("m.toml") + " --physics --quiet").code, verdict.code);
  }
}

// A zigzag turns X back nine times, and the run rests there until 0.5 mm of backlash are taken up.
TEST_F(CheckMargin, knows_the_time_that_backlash_takes) {
  std::string zigzag = "G21 G90\n";
  for (int i = 0; i < 10; ++i) zigzag += i % 2 == 0 ? "G1 X20 F3000\n" : "G1 X-20\n";
  const std::string program = write("zigzag.ngc", zigzag + "M2\n");
  const auto seconds_of = [&](const std::string& more) {
    const Outcome outcome = passo("check " + program + " --json -m " + write("m.toml", with_motor(500, more)));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["time_s"].get<double>();
  };
  const std::string screw = "[axis.X.screw]\nbacklash_mm = 0.5\n";
  const double longer = seconds_of(screw) - seconds_of("");
  const double once = 2 * std::sqrt(0.5 / 500);  // half of the way faster and faster, then slower and slower
  EXPECT_NEAR(longer, 9 * once, 1.5 * once);

  const Outcome run = passo("run " + program + " -m " + path("m.toml") + " --quiet");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(CheckMargin, says_nothing_of_motors_that_the_machine_file_does_not_know) {
  const Outcome outcome = passo("check " + write("p.ngc", "G21\nG0 X3\nM2\n") +
                                " -m " PASSO_SOURCE_DIR "/examples/machines/router.toml --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(nlohmann::json::parse(outcome.out)["margin"].is_null());
}

// A slot of 6 mm, 2 mm deep, at 10 mm/s and 12,000 turns a minute: P = k·12·10, over a cutting speed of 3770 mm/s.
class CheckCut : public CheckMargin {
 protected:
  static std::string machine() {
    return with_motor(100) +
           "[axis.Z]\nsteps_per_turn = 200\nmicrosteps = 8\nscrew_pitch_mm = 4\ntravel_mm = [-50, 50]\n"
           "max_velocity_mm_s = 20\nmax_acceleration_mm_s2 = 100\n";
  }
  Outcome cut(const std::string& options, const std::string& spindle = "S12000 M3\n") const {
    const std::string program = "G21 G90\n" + spindle + "G0 X-10\nG0 Z-2\nG1 X30 F600\nG0 Z5\nM2\n";
    return passo("check " + write("p.ngc", program) + " -m " + write("m.toml", machine()) +
                 " --tool flat:6 --cell 0.1 " + options);
  }
  static constexpr const char* block = " --stock X0:40,Y-10:10,Z-10:0";
};

TEST_F(CheckCut, adds_its_force_to_what_the_motors_need) {
  const Outcome soft = cut(std::string("--cutting-force 800 --json") + block);
  ASSERT_EQ(soft.code, 0) << soft.err;
  const auto json = nlohmann::json::parse(soft.out);
  EXPECT_NEAR(json["cut"]["most_force_n"], 800 * 12 * 10 / 3770.0, 1);
  EXPECT_EQ(json["cut"]["most_force_line"], 5);
  EXPECT_EQ(json["margin"]["verdict"], "safe");

  const Outcome hard = cut(std::string("--cutting-force 20000") + block);
  EXPECT_EQ(hard.code, 1);
  EXPECT_THAT(hard.out, HasSubstr("cut             "));
  EXPECT_THAT(hard.out, HasSubstr(" of it for the cut"));
  EXPECT_THAT(hard.err, HasSubstr("[check.steps-lost]"));
}

TEST_F(CheckCut, wants_a_spindle_speed_and_the_material) {
  const Outcome silent = cut(std::string("--cutting-force 20000") + block, "");
  EXPECT_EQ(silent.code, 0) << "nothing is known of its force: " << silent.err;
  EXPECT_THAT(silent.err, HasSubstr("[check.no-spindle-speed]"));
  EXPECT_EQ(cut(std::string("--cutting-force 20000 --spindle-speed 12000") + block, "").code, 1);
  EXPECT_THAT(cut("").err, HasSubstr("--cutting-force is missing"));
  EXPECT_THAT(cut("--cutting-force nan").err, HasSubstr("expected a number from 0.1 to 20000"));
  EXPECT_THAT(cut("--cutting-force 800 --stock X9:1").err, HasSubstr("--stock: expected"));
}

TEST_F(CheckCut, fails_for_a_rapid_through_the_stock) {
  const Outcome outcome = passo("check " + write("r.ngc", "G21 G90 S12000 M3\nG0 Z5\nG0 Z-2\nG1 X30 F300\nM2\n") +
                                " -m " + write("m.toml", machine()) + " --tool flat:6 --cell 0.1 --cutting-force 700");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[simulate.rapid]"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("no errors")));
}

// A machine that rounds corners is cut along the same path that is planned.
TEST_F(CheckCut, finds_the_force_of_every_feed_of_an_example) {
  const std::string examples = std::string(PASSO_SOURCE_DIR) + "/examples/";
  const Outcome outcome = passo("check " + examples + "pocket.ngc -m " + examples +
                                "machines/strong-router.toml --tool flat:6 --cutting-force 800 --json");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["cut"]["feeds_without_force"], 0);
  EXPECT_GT(json["cut"]["most_force_n"], 1);
}

}  // namespace
