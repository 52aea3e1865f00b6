// Motors with physics as a user sees them: `passo run --physics` and `passo motor --trial`.
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

// A machine with one axis and a motor that is not asked what it can do: the acceleration is given.
std::string machine_text(double acceleration) {
  return "name = \"weak\"\n[board]\nclock_hz = 16_000_000\nmax_event_rate_hz = 100_000\n"
         "[axis.X]\nsteps_per_turn = 200\nmicrosteps = 8\nscrew_pitch_mm = 4\ntravel_mm = [-100, 100]\n"
         "max_velocity_mm_s = 40\nmax_acceleration_mm_s2 = " +
         std::to_string(acceleration) +
         "\n[axis.X.torque]\nholding_torque_nm = 0.45\nrated_current_a = 1.7\nresistance_ohm = 1.5\n"
         "inductance_mh = 2.8\nsupply_v = 24\nrotor_inertia_g_cm2 = 68\nload_mass_kg = 4\nfriction_n = 10\n"
         "share_of_pull_out = 1\n";
}

class Physics : public passo::test::CommandLine {
 protected:
  Outcome run(const std::string& options, double acceleration = 800) const {
    return passo("run " + write("p.ngc", "G21 G90\nG0 X30\nG0 X-30\nG0 X0\nM2\n") + " -m " +
                 write("m.toml", machine_text(acceleration)) + " " + options);
  }
};

TEST_F(Physics, of_a_gentle_machine_loses_nothing) {
  const Outcome outcome = run("--physics --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto physics = nlohmann::json::parse(outcome.out)["physics"];
  ASSERT_EQ(physics["motors"].size(), 1U);
  EXPECT_EQ(physics["motors"][0]["axis"], "X");
  EXPECT_EQ(physics["motors"][0]["lost_steps"], 0);
  EXPECT_GT(physics["motors"][0]["margin"], 0);
  EXPECT_GT(physics["motors"][0]["following_error_mm"], 0);
  EXPECT_TRUE(physics["losses"].empty());
}

TEST_F(Physics, is_told_in_the_summary) {
  const Outcome outcome = run("--physics");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nMotors, mm"));
  EXPECT_THAT(run("").out, Not(HasSubstr("\nMotors")));
}

// The weight is more than the motor holds.
TEST_F(Physics, of_a_motor_that_is_too_weak_loses_steps_and_says_so) {
  std::string weak = machine_text(800);
  weak.replace(weak.find("friction_n = 10"), 15, "weight_n = 600\n");
  const Outcome outcome =
      passo("run " + write("p.ngc", "G21 G90\nG0 X30\nM2\n") + " -m " + write("m.toml", weak) + " --physics --json");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[run.steps-lost]"));
  const auto physics = nlohmann::json::parse(outcome.out)["physics"];
  EXPECT_NE(physics["motors"][0]["lost_steps"], 0);
  ASSERT_FALSE(physics["losses"].empty());
  EXPECT_EQ(physics["losses"][0]["axis"], "X");
  EXPECT_EQ(physics["losses"][0]["line"], 2);
  EXPECT_EQ(static_cast<int>(physics["losses"][0]["steps"]) % 32, 0);
}

TEST_F(Physics, needs_motors) {
  const std::string uno = std::string(PASSO_SOURCE_DIR) + "/examples/machines/uno.toml";
  const Outcome outcome = passo("run " + write("p.ngc", "G21 G0 X1\nM2\n") + " -m " + uno + " --physics");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("[axis.X.torque]"));
}

// Something holds X for 50 ms, with more than the motor has.
class Held : public Physics {
 protected:
  Outcome run_held(const std::string& encoder, const std::string& options = "") const {
    return passo("run " + write("p.ngc", "G21 G90\nG0 X30\nG0 X-30\nG0 X0\nM2\n") + " -m " +
                 write("m.toml", machine_text(800) + encoder) + " --physics --json --disturb X:3@1.5:0.05" + options);
  }
};

TEST_F(Held, loses_steps_in_an_open_loop) {
  const Outcome outcome = run_held("");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[run.steps-lost]"));
}

TEST_F(Held, comes_back_in_a_closed_loop) {
  const Outcome outcome = run_held("[axis.X.encoder]\ncounts_per_turn = 4000\nclosed_loop = true\n");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto motor = nlohmann::json::parse(outcome.out)["physics"]["motors"][0];
  EXPECT_EQ(motor["lost_steps"], 0);
  EXPECT_GT(motor["following_error_mm"], 0.5);
}

TEST_F(Held, stops_at_the_limit_of_the_following_error_and_tells_line_and_place) {
  for (const char* loop : {"", "closed_loop = true\n"}) {
    const Outcome outcome =
        run_held(std::string("[axis.X.encoder]\ncounts_per_turn = 4000\nmost_following_error_mm = 0.25\n") + loop);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("axis X was 0.25"));
    EXPECT_THAT(outcome.err, HasSubstr("from its commanded position (0.25 are allowed) in line 3 of "));
    EXPECT_THAT(outcome.err, HasSubstr("near X"));
    EXPECT_THAT(outcome.err, HasSubstr("[run.following-error]"));
  }
}

// The example of docs/ramps/loop.md.
TEST_F(Held, of_the_document_loses_steps_without_an_encoder_and_none_with_one) {
  const std::string folder = std::string(PASSO_SOURCE_DIR) + "/examples/troubles/";
  const auto lost = [&](const std::string& machine, const std::string& disturbance) {
    const Outcome outcome =
        passo("run " + folder + "blocked.ngc -m " + folder + machine + " --physics --json" + disturbance);
    const auto steps = nlohmann::json::parse(outcome.out)["physics"]["motors"][0]["lost_steps"].get<int>();
    EXPECT_EQ(outcome.code, steps == 0 ? 0 : 1);
    return steps;
  };
  EXPECT_EQ(lost("blocked.toml", ""), 0);
  EXPECT_EQ(lost("blocked.toml", " --disturb X:0.6@2:0.1"), 448);
  EXPECT_EQ(lost("blocked-closed.toml", " --disturb X:0.6@2:0.1"), 0);
}

// The drive's alarm presses the emergency stop of a board whose firmware runs on an emulated chip.
TEST_F(Held, stops_an_emulated_board_or_comes_back_on_it) {
  const std::string encoder = "[axis.X.encoder]\ncounts_per_turn = 4000\n";
  const Outcome open = run_held(encoder + "most_following_error_mm = 0.25\n", " --board sim:uno");
  if (passo::test::lacks_an_emulator(open)) GTEST_SKIP() << open.err;
  EXPECT_EQ(open.code, 1);
  EXPECT_THAT(open.err, HasSubstr("axis X was 0.25"));
  EXPECT_THAT(open.err, HasSubstr("(0.25 are allowed) in line 3 of "));
  EXPECT_THAT(open.err, HasSubstr("[run.following-error]; closed now: emergency stop"));

  const Outcome closed = run_held(encoder + "closed_loop = true\n", " --board sim:uno");
  ASSERT_EQ(closed.code, 0) << closed.err;
  const auto motor = nlohmann::json::parse(closed.out)["physics"]["motors"][0];
  EXPECT_EQ(motor["lost_steps"], 0);
  EXPECT_GT(motor["following_error_mm"], 0.5);
}

TEST_F(Held, needs_physics_and_a_motor) {
  EXPECT_EQ(
      passo("run " + write("p.ngc", "M2\n") + " -m " + write("m.toml", machine_text(800)) + " --disturb X:3@1.5:0.05")
          .code,
      2);
  for (const char* text : {"Y:1@1:1", "X", "X:1@1", "X:a@1:1", "X:-1@1:1"}) {
    EXPECT_THAT(run_held("", std::string(" --disturb ") + text).err, HasSubstr("expected --disturb")) << text;
  }
}

class Trial : public passo::test::CommandLine {
 protected:
  Outcome trial(const std::string& options) const {
    return passo(
        "motor --holding-torque 0.45 --current 1.7 --resistance 1.5 --inductance 2.8 --rotor-inertia 68 "
        "--supply 24 --load-inertia 68 " +
        options);
  }
};

TEST_F(Trial, prints_a_table) {
  const Outcome step = trial("--trial step --excitation two-on");
  ASSERT_EQ(step.code, 0) << step.err;
  EXPECT_TRUE(step.out.starts_with("time_s,commanded_full_steps,place_full_steps,"));
  const Outcome torque = trial("--trial torque --rows 3 --max-rate 900");
  ASSERT_EQ(torque.code, 0) << torque.err;
  EXPECT_TRUE(torque.out.starts_with("rate_hz,pull_out_nm,pull_in_nm\n300,"));
}

TEST_F(Trial, draws_a_picture) {
  for (const char* kind : {"torque", "step", "stop", "resonance"}) {
    const std::string file = path(std::string(kind) + ".svg");
    const Outcome outcome = trial("--rows 5 --max-rate 1000 --trial " + std::string(kind) + " --picture " + file);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(passo::test::read(file), HasSubstr("</svg>"));
  }
}

TEST_F(Trial, refuses_what_it_does_not_know) {
  EXPECT_THAT(trial("--trial step --excitation thirds").err, HasSubstr("expected two-on, wave, half-step"));
  EXPECT_EQ(trial("--trial jump").code, 2);
  EXPECT_THAT(trial("--trial stop --steps 0").err, HasSubstr("--steps must be"));
}

}  // namespace
