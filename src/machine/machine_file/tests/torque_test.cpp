// [axis.X.torque]: an axis whose acceleration follows its motor.
#include <cmath>
#include <numbers>

#include "machine_text.hpp"

namespace passo {
namespace {

// 100 steps a millimetre, given by motor and screw. 25 mm/s are 6.25 turns or 1250 full steps a second.
std::string with_torque(const std::string& keys, const std::string& constant = "") {
  return replaced(replaced(sound_machine, "steps_per_mm = 100", "steps_per_turn = 400\nscrew_pitch_mm = 4"),
                  "max_acceleration_mm_s2 = 200", constant + "\n[axis.X.torque]\n" + keys);
}

const std::string points = "pull_out_steps_s_nm = [[0, 1.0], [1000, 0.8], [2000, 0.4]]\nrotor_inertia_g_cm2 = 300\n";
const std::string winding =
    "holding_torque_nm = 1.9\nrated_current_a = 2.8\nresistance_ohm = 1.13\ninductance_mh = 3.6\nsupply_v = 36\n"
    "rotor_inertia_g_cm2 = 480\n";

MachineDescription read(const std::string& text) {
  Diagnostics diagnostics;
  auto machine = parse_machine(text, "m.toml", diagnostics);
  EXPECT_EQ(render(diagnostics, false), "");
  return machine.value_or(MachineDescription{});
}

TEST(Torque, leaves_a_share_of_pull_out_less_friction_for_all_that_is_moved) {
  const auto machine = read(with_torque(
      points +
      "load_inertia_g_cm2 = 100\nload_mass_kg = 10\nfriction_n = 20\nfriction_nm = 0.05\nshare_of_pull_out = 0.5\n"));
  ASSERT_TRUE(machine.axes.at(0).motor);
  const double way = 0.004 / (2 * std::numbers::pi);  // metres for each radian
  const double inertia = 400e-7 + 10 * way * way;
  const auto expected = [&](double torque) { return (0.5 * torque - 0.05 - 20 * way) / inertia * way * 1e3; };
  EXPECT_NEAR(machine.axes[0].acceleration.value(), expected(1.0), 1e-9 * expected(1));
  EXPECT_NEAR(machine.axes[0].acceleration_at(MmPerSecond(20)).value(), expected(0.8), 1e-9 * expected(1));
}

TEST(Torque, is_computed_from_the_data_of_a_motor) {
  const auto machine = read(with_torque(winding));
  ASSERT_TRUE(machine.axes.at(0).motor);
  const double way = 4 / (2 * std::numbers::pi);
  EXPECT_NEAR(machine.axes[0].acceleration.value(), 0.7 * 1.9 / std::sqrt(2.0) / 480e-7 * way, 1e-6);
  EXPECT_LE(machine.axes[0].acceleration_at(MmPerSecond(25)), machine.axes[0].acceleration);
}

TEST(Torque, stays_below_a_constant_that_is_given_too) {
  const auto machine = read(with_torque(points, "max_acceleration_mm_s2 = 150"));
  EXPECT_EQ(machine.axes.at(0).acceleration, MmPerSecond2(150));
  EXPECT_EQ(machine.axes.at(0).acceleration_at(MmPerSecond(1)), MmPerSecond2(150));
}

TEST(Torque, never_rises_with_the_speed) {
  for (const std::string& keys : {points, winding}) {
    const auto machine = read(with_torque(keys));
    MmPerSecond2 before = machine.axes.at(0).acceleration;
    for (double v = 0; v <= 25; v += 0.01) {
      const MmPerSecond2 here = machine.axes[0].acceleration_at(MmPerSecond(v));
      ASSERT_LE(here, before) << v;
      ASSERT_GT(here.value(), 0);
      before = here;
    }
  }
}

TEST(Torque, of_a_motor_that_is_only_checked_does_not_limit) {
  const auto machine =
      read(with_torque(points + "limits_motion = false\ntolerance = 0.1\n", "max_acceleration_mm_s2 = 9000"));
  ASSERT_TRUE(machine.axes.at(0).motor);
  EXPECT_EQ(machine.axes[0].motor->tolerance, 0.1);
  EXPECT_EQ(machine.axes[0].acceleration_at(MmPerSecond(25)), MmPerSecond2(9000));
  EXPECT_EQ(read(with_torque(points)).axes.at(0).motor->tolerance, usual_tolerance);
}

TEST(Torque, is_shown_at_a_few_speeds) {
  EXPECT_THAT(describe(read(with_torque(points, "max_acceleration_mm_s2 = 150"))),
              testing::HasSubstr("0.7 of pull-out: 150 mm/s2 at 0 mm/s, 150 mm/s2 at 6.25 mm/s, "));
}

struct Wrong {
  std::string text;
  const char* code;
  const char* marked;  // the text at the caret
};

TEST(Torque, tells_what_is_wrong_and_where) {
  const std::string screw = "screw_pitch_mm = 4";
  const Wrong all[] = {
      {with_torque(replaced(points, "0.8", "1.8")), "machine.torque", "[[0, 1.0]"},
      {with_torque(replaced(points, "[1000, 0.8]", "[1000]")), "machine.wrong-type", "[1000]"},
      {with_torque(replaced(points, "[1000, 0.8]", "[1000, \"much\"]")), "machine.wrong-type", "\"much\""},
      {with_torque(replaced(points, "0.8", "-0.8")), "machine.out-of-range", "-0.8"},
      {with_torque(replaced(points, "[[0, 1.0], [1000, 0.8], [2000, 0.4]]", "1.0")), "machine.wrong-type", "1.0"},
      {with_torque(points + "supply_v = 36\n"), "machine.torque", "36"},
      {with_torque(points + "share_of_pull_out = 1.5\n"), "machine.out-of-range", "1.5"},
      {with_torque(points + "load_mass = 1\n"), "machine.unknown-key", "load_mass"},
      {with_torque(replaced(winding, "supply_v = 36\n", "")), "machine.missing-key", "torque]"},
      {with_torque(winding + "drive = \"strong\"\n"), "machine.torque", "\"strong\""},
      {with_torque(winding + "full_steps_per_turn = 202\n"), "machine.torque", "1.9"},
      {with_torque(replaced(points, "rotor_inertia_g_cm2 = 300\n", "")), "machine.missing-key", "torque]"},
      {with_torque(points + "limits_motion = false\n"), "machine.missing-key", "X]"},
      {with_torque(points + "tolerance = 0.6\n"), "machine.out-of-range", "0.6"},
      {with_torque(points + "friction_nm = 0.6\n"), "machine.too-weak", "25"},
      {replaced(replaced(with_torque(points), screw, ""), "steps_per_turn = 400", "steps_per_mm = 100"),
       "machine.torque", "torque]"},
  };
  for (const Wrong& wrong : all) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_machine(wrong.text, "m.toml", diagnostics)) << wrong.marked;
    ASSERT_EQ(diagnostics.all().size(), 1U) << render(diagnostics, false);
    const Diagnostic& found = diagnostics.all()[0];
    EXPECT_EQ(found.code, wrong.code) << render(diagnostics, false);
    ASSERT_GT(found.place.column, 0U);
    EXPECT_EQ(found.text.substr(found.place.column - 1).find(wrong.marked), 0U) << render(diagnostics, false);
    EXPECT_FALSE(found.expected.empty());
  }
}

}  // namespace
}  // namespace passo
