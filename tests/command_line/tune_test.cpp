// `passo tune`: what it proposes, `passo check` calls safe, and full physics loses no step.
#include <cmath>
#include <random>

#include "kit/command_line.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

const std::string strong = std::string(PASSO_SOURCE_DIR) + "/examples/machines/strong-router.toml";

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  double about(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  template <class T>
  T choice(std::initializer_list<T> values) {
    const auto count = static_cast<double>(values.size());
    return values.begin()[std::min(values.size() - 1, static_cast<std::size_t>(between(0, count)))];
  }

 private:
  std::mt19937_64 random_;
};

// A motor in the proportions of data sheets, with limits that are far too high for it.
struct DrawnAxis {
  explicit DrawnAxis(char name, Draw& draw)
      : letter(name),
        torque(draw.about(0.2, 3)),
        current(draw.between(1, 4)),
        inductance(draw.between(0.8, 1.5) * torque / (std::sqrt(2.0) * current) / 50 / current),
        resistance(inductance / draw.between(1.5e-3, 4e-3)),
        rotor(torque * draw.between(150, 260)),
        load(rotor * draw.between(0.2, 3)),
        friction(torque * draw.between(0.02, 0.15)),
        supply(draw.choice({24.0, 36.0, 48.0})),
        pitch(draw.choice({2.0, 4.0, 5.0, 10.0})),
        microsteps(draw.choice({4, 8, 16})) {}

  // The motor is stronger or weaker by that factor.
  std::string text(double factor) const {
    return fmt::format(
        "[axis.{}]\nsteps_per_turn = 200\nmicrosteps = {}\nscrew_pitch_mm = {}\ntravel_mm = [-100, 100]\n"
        "max_velocity_mm_s = 40 # was a guess\nmax_acceleration_mm_s2 = 5000\n[axis.{}.torque]\nlimits_motion = false\n"
        "tolerance = 0.15\nholding_torque_nm = {:.5f}\nrated_current_a = {:.5f}\nresistance_ohm = {:.5f}\n"
        "inductance_mh = {:.5f}\nrotor_inertia_g_cm2 = {:.5f}\nsupply_v = {}\nload_inertia_g_cm2 = {:.5f}\n"
        "friction_nm = {:.6f}\n",
        letter, microsteps, pitch, letter, factor * torque, current, resistance, inductance * 1e3, rotor, supply, load,
        friction);
  }

  char letter;
  double torque;
  double current;
  double inductance;
  double resistance;
  double rotor;  // g·cm²
  double load;
  double friction;
  double supply;
  double pitch;
  int microsteps;
};

const std::string head =
    "name = \"drawn\"\n[board]\nclock_hz = 72_000_000\nmax_event_rate_hz = 400_000\nstep_pulse_us = 1\n";

std::string drawn_program(double velocity, Draw& draw) {
  std::string text = "G21 G90\n";
  for (int i = 0; i < 14; ++i) {
    text += draw.between(0, 1) < 0.3 ? "G0" : fmt::format("G1 F{:.1f}", draw.between(0.1, 1) * 60 * velocity);
    text += fmt::format(" X{:.3f} Y{:.3f}\n", draw.between(-60, 60), draw.between(-60, 60));
  }
  return text + "M2\n";
}

class Tune : public passo::test::CommandLine {};

TEST_F(Tune, writes_a_copy_with_its_comments) {
  const Outcome outcome =
      passo("tune -m " + strong + " --axes Z --margin 0.5 -o " + path("copy.toml") + " -p " + path("curves.svg"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("axis Z: 50 % of the guaranteed torque is reserved"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("axis X")));
  EXPECT_THAT(passo::test::read(path("curves.svg")), HasSubstr("</svg>"));
  std::istringstream old_lines(passo::test::read(strong));
  std::istringstream new_lines(passo::test::read(path("copy.toml")));
  // Two lines are changed, a line with the jerk is new, and no comment is lost.
  std::vector<std::string> changed;
  std::string old_line;
  std::getline(old_lines, old_line);
  for (std::string line; std::getline(new_lines, line);) {
    if (line == old_line) {
      std::getline(old_lines, old_line);
    } else {
      changed.push_back(line);
      if (old_line.substr(0, old_line.find(' ')) == line.substr(0, line.find(' '))) {
        EXPECT_EQ(old_line.find('#') == std::string::npos, line.find('#') == std::string::npos) << line;
        std::getline(old_lines, old_line);
      }
    }
  }
  ASSERT_EQ(changed.size(), 3U);
  EXPECT_TRUE(changed[0].starts_with("max_velocity_mm_s = "));
  EXPECT_THAT(changed[1], HasSubstr("# more would shake the column"));
  EXPECT_TRUE(changed[2].starts_with("max_jerk_mm_s3 = "));
  EXPECT_EQ(passo("machine " + path("copy.toml")).code, 0);
}

TEST_F(Tune, keeps_a_velocity_that_something_else_sets) {
  const Outcome outcome = passo("tune -m " + strong + " --axes Z --keep-velocity --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["verdict"], "safe");
  EXPECT_LE(json["axes"][0]["velocity"], 80);
  EXPECT_EQ(json["values"][0]["key"], "axis.Z.max_velocity_mm_s");
}

// A slower axis must not be asked to home or to start at the old speeds.
TEST_F(Tune, lowers_what_may_not_be_above_the_velocity) {
  Draw draw(3);
  const DrawnAxis x('X', draw);
  std::string text = head + x.text(1);
  text.replace(text.find("max_velocity_mm_s = 40"), 22, "max_velocity_mm_s = 900\nstart_stop_velocity_mm_s = 890");
  text +=
      "[axis.X.home]\ndirection = \"low\"\nswitch_at_mm = -101\nseek_mm_s = 880 # fast\nlatch_mm_s = 1\npull_off_mm = "
      "2\n";
  const Outcome outcome = passo("tune -m " + write("m.toml", text) + " -o " + path("copy.toml"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(passo::test::read(path("copy.toml")), Not(HasSubstr("880")));
  EXPECT_THAT(passo::test::read(path("copy.toml")), HasSubstr("# fast"));
  EXPECT_EQ(passo("machine " + path("copy.toml")).code, 0);
}

TEST_F(Tune, refuses_what_it_cannot_do) {
  const std::string uno = std::string(PASSO_SOURCE_DIR) + "/examples/machines/uno.toml";
  EXPECT_EQ(passo("tune -m " + uno).code, 3);
  EXPECT_EQ(passo("tune -m " + strong + " --axes XQ").code, 3);
  EXPECT_EQ(passo("tune -m " + strong + " --margin 0.95").code, 2);
  EXPECT_EQ(passo("tune -m " + strong + " -p curves.pdf").code, 2);
  EXPECT_EQ(passo("tune -m " + strong + " -o " + strong).code, 2);
  Draw draw(5);
  DrawnAxis stuck('X', draw);
  stuck.friction = 2 * stuck.torque;
  const Outcome outcome = passo("tune -m " + write("m.toml", head + stuck.text(1)));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("axis X: friction and weight need"));
  EXPECT_THAT(outcome.err, HasSubstr("[tune.impossible]"));
}

// The limits of a tuned machine, and the motors of the tolerance: the weakest, the usual and the strongest.
TEST_F(Tune, of_seeded_machines_is_safe_and_loses_no_step) {
  const char* const runs = std::getenv("PASSO_RUNS");
  const int count = runs != nullptr ? std::atoi(runs) : 1;
  const std::uint64_t seed = passo::test::seed();
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(fmt::format("seed {}", seed + static_cast<std::uint64_t>(i)));
    Draw draw(seed + static_cast<std::uint64_t>(i));
    const DrawnAxis x('X', draw);
    const DrawnAxis y('Y', draw);
    const std::string text = head + x.text(1) + y.text(1);
    const Outcome tuned = passo("tune --json -m " + write("m.toml", text) + " -o " + path("copy.toml"));
    ASSERT_EQ(tuned.code, 0) << tuned.err << text;
    const auto json = nlohmann::json::parse(tuned.out);
    const double velocity =
        std::max(json["axes"][0]["velocity"].get<double>(), json["axes"][1]["velocity"].get<double>());
    const std::string program = write("p.ngc", drawn_program(velocity, draw));
    const Outcome checked = passo("check --json " + program + " -m " + path("copy.toml"));
    ASSERT_EQ(checked.code, 0) << checked.err;
    EXPECT_EQ(nlohmann::json::parse(checked.out)["margin"]["verdict"], "safe") << checked.out;
    const std::string copy = passo::test::read(path("copy.toml"));
    for (const double factor : {0.85, 1.0, 1.15}) {
      std::string other = copy;
      for (const DrawnAxis* axis : {&x, &y}) {
        const std::string is = fmt::format("holding_torque_nm = {:.5f}\n", axis->torque);
        const std::size_t at = other.find(is);
        ASSERT_NE(at, std::string::npos);
        other.replace(at, is.size(), fmt::format("holding_torque_nm = {:.5f}\n", factor * axis->torque));
      }
      const Outcome run = passo("run --physics --json " + program + " -m " + write("other.toml", other));
      EXPECT_EQ(run.code, 0) << factor << run.err;
    }
  }
}

}  // namespace
