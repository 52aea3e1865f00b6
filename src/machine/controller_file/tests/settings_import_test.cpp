#include "imported.hpp"
#include <gtest/gtest.h>

namespace passo::test {
namespace {

TEST(SettingsImport, keeps_the_numbers_of_grbl) {
  const Imported it = imported_example("grbl.txt");
  EXPECT_EQ(it.result->format, ImportFormat::settings);
  EXPECT_EQ(it.result->controller, "Grbl");
  ASSERT_EQ(it.machine->axes.size(), 3U);
  const AxisDescription& x = it.axis(Axis::x);
  EXPECT_EQ(x.steps_per_unit, 320);
  EXPECT_EQ(x.velocity.value(), 100);
  EXPECT_EQ(x.acceleration.value(), 400);
  EXPECT_EQ(x.travel_low, -410);
  EXPECT_EQ(x.travel_high, 0);
  EXPECT_FALSE(x.inverted);
  EXPECT_TRUE(it.axis(Axis::z).inverted);
  EXPECT_EQ(it.machine->tool.highest_rpm, 12000);
  EXPECT_DOUBLE_EQ(it.machine->board.step_pulse.value(), 3e-6);
  EXPECT_EQ(it.target_of("$110"), "axis.X.max_velocity_mm_s = 100");
  EXPECT_EQ(it.reason_of("$11"), "no equivalent: Passo rounds corners within path_tolerance_mm");
  EXPECT_TRUE(it.warns_of("no motor data"));
}

TEST(SettingsImport, homes_as_grbl_does) {
  const Imported it = imported_example("grbl.txt");
  const HomeDescription& x = it.axis(Axis::x).home.value();
  EXPECT_FALSE(x.toward_high);
  EXPECT_EQ(x.switch_at, -410);
  EXPECT_EQ(x.seek.value(), 20);
  EXPECT_EQ(x.latch.value(), 1);
  EXPECT_EQ(x.pull_off, 1.5);
  const HomeDescription& z = it.axis(Axis::z).home.value();
  EXPECT_TRUE(z.toward_high);
  EXPECT_EQ(z.switch_at, 0);
  EXPECT_EQ(it.machine->homing.front(), Axis::z);
  const Imported off = imported(replaced(example_text("grbl.txt"), "$22=1", "$22=0"));
  EXPECT_FALSE(off.axis(Axis::x).home.has_value());
  EXPECT_EQ(off.reason_of("$25"), "homing is off ($22)");
  // Its zero is where it was switched on.
  EXPECT_EQ(off.axis(Axis::x).travel_low, -410);
  EXPECT_EQ(off.axis(Axis::x).travel_high, 410);
  EXPECT_TRUE(off.warns_of("where the machine is switched on"));
}

TEST(SettingsImport, levels_of_grbl_and_grblhal_have_opposite_meanings) {
  const Imported grbl = imported_example("grbl.txt");  // $5=1: normally closed
  EXPECT_TRUE(grbl.machine->pins.limits_high[0] && grbl.machine->pins.limits_high[2]);
  EXPECT_FALSE(grbl.machine->pins.driver_enable_high);
  const Imported hal = imported_example("grblhal.txt");  // $5=11: X, Y and A are normally open
  EXPECT_FALSE(hal.machine->pins.limits_high[0] || hal.machine->pins.limits_high[1] ||
               hal.machine->pins.limits_high[3]);
  EXPECT_TRUE(hal.machine->pins.limits_high[2]);
  EXPECT_FALSE(hal.machine->pins.driver_enable_high);  // $4=15
  EXPECT_FALSE(hal.machine->pins.probe_high);          // $6=1
}

TEST(SettingsImport, knows_the_settings_that_only_grblhal_has) {
  const Imported it = imported_example("grblhal.txt");
  EXPECT_EQ(it.result->controller, "grblHAL");
  ASSERT_EQ(it.machine->axes.size(), 4U);
  EXPECT_TRUE(it.axis(Axis::y).second.has_value());
  EXPECT_TRUE(it.axis(Axis::y).second->inverted);  // $8=2
  EXPECT_EQ(it.axis(Axis::x).screw->backlash, 0.03);
  EXPECT_EQ(it.axis(Axis::a).velocity.value(), 120);
  // $22=9: the origin is at the switch, and X homes to its low end.
  EXPECT_EQ(it.axis(Axis::x).travel_low, 0);
  EXPECT_EQ(it.axis(Axis::x).travel_high, 600);
  EXPECT_EQ(it.axis(Axis::y).travel_low, -900);
  EXPECT_TRUE(it.machine->pins.emergency_stop_high);  // $14=6, [SIGNALS:HSE]
  EXPECT_FALSE(it.machine->pins.feed_hold_high);
  EXPECT_FALSE(it.machine->pins.door_high);  // there is no door
  EXPECT_TRUE(it.machine->pins.flood_low);
  EXPECT_FALSE(it.machine->pins.mist_low);
  EXPECT_DOUBLE_EQ(it.machine->pins.enable_wait.value(), 0.2);
  EXPECT_TRUE(it.warns_of("$20=0"));
  EXPECT_FALSE(it.axis(Axis::a).home.has_value());  // in no homing cycle
}

TEST(SettingsImport, reads_what_people_write_around_a_setting) {
  const Imported it = imported(
      "(my machine)\r\n< $100=26.67 (x, step/mm)\r\n$110 = 8000\t(fast)\r\n$120=200\r\n$130=1800\r\n"
      "$130=780  (measured)\r\nok\r\n");
  ASSERT_TRUE(it.machine.has_value());
  EXPECT_EQ(it.axis(Axis::x).steps_per_unit, 26.67);
  EXPECT_EQ(it.axis(Axis::x).travel_low, -780);
  EXPECT_EQ(it.reason_of("$130"), "this setting is given twice: the last one counts");
}

TEST(SettingsImport, velocities_that_are_no_decimals_are_the_nearest_number) {
  const Imported it = imported("$100=250\n$110=500\n$120=10\n$130=200\n");
  EXPECT_EQ(it.axis(Axis::x).velocity.value(), 500.0 / 60);
}

TEST(SettingsImport, shortens_a_pulse_that_does_not_fit) {
  const Imported it = imported("$0=10\n$100=800\n$110=6000\n$120=10\n$130=200\n");  // 80,000 steps/s
  EXPECT_NEAR(it.machine->board.step_pulse.value(), 6.25e-6, 1e-9);
  EXPECT_TRUE(it.warns_of("step_pulse_us = 6.25 instead"));
}

TEST(SettingsImport, refuses_with_the_place) {
  const Imported comma = imported("$100=12,5\n$110=500\n$120=10\n$130=200\n");
  EXPECT_EQ(comma.first_code(), "import.not-a-number");
  EXPECT_EQ(comma.first().place, (SourceLocation{.line = 1, .column = 6, .length = 4}));
  EXPECT_EQ(comma.first().text, "$100=12,5");
  const Imported zero = imported("$100=100\n$110=0\n$120=10\n$130=200\n");
  EXPECT_EQ(zero.first_code(), "import.out-of-range");
  EXPECT_EQ(zero.first().place.line, 2U);
  EXPECT_EQ(imported("$100=100\n$120=10\n").first_code(), "import.missing-key");
  EXPECT_EQ(imported("$110=100\n$120=10\n").first_code(), "import.no-axis");
  EXPECT_EQ(imported("[KINEMATICS:Delta v1]\n$100=100\n").first_code(), "import.kinematics");
  EXPECT_EQ(imported("Hello\n").first_code(), "import.unknown-format");
  EXPECT_EQ(imported("$100=1e300\n$110=1\n$120=1\n").first_code(), "import.out-of-range");
  EXPECT_EQ(imported("$100=100000\n$110=600000\n$120=1\n").first_code(), "import.too-fast");
}

TEST(SettingsImport, reads_a_core_xy) {
  const std::string settings =
      "$100=80\n$101=80\n$102=400\n$110=6000\n$111=6000\n$112=600\n$120=500\n$121=500\n$122=50\n"
      "$130=300\n$131=200\n$132=50\n";
  for (const char* about : {"[VER:1.1h.20190830:]\n[OPT:VC,15,128]\n",
                            "[VER:1.1f.20260817:]\n[OPT:VNML+,100,1024,3,0]\n[FIRMWARE:grblHAL]\n"
                            "[KINEMATICS:CoreXY v2.02]\n",
                            "[VER:1.1f.20260817:]\n[OPT:VNMCL+,100,1024,3,0]\n[FIRMWARE:grblHAL]\n"}) {
    const Imported it = imported(about + settings);
    ASSERT_TRUE(it.machine) << about;
    EXPECT_TRUE(it.machine->is_core_xy) << about;
    EXPECT_TRUE(it.warns_of("only its own board with Grbl can drive it"));
    EXPECT_NE(it.result->toml.find("kinematics = \"corexy\""), std::string::npos);
  }
  EXPECT_FALSE(imported("[VER:1.1h.20190830:]\n[OPT:V,15,128]\n" + settings).machine->is_core_xy);
  // A backlash is that of a screw, which X does not have.
  const Imported with_backlash =
      imported("[VER:1.1f:]\n[FIRMWARE:grblHAL]\n[KINEMATICS:CoreXY v2.02]\n" + settings + "$160=0.1\n");
  ASSERT_TRUE(with_backlash.machine);
  EXPECT_FALSE(with_backlash.axis(Axis::x).screw);
  EXPECT_EQ(with_backlash.reason_of("$160"), "no equivalent for an axis of a CoreXY");
  const Imported uneven = imported("[OPT:VC,15,128]\n" + replaced(settings, "$101=80", "$101=90"));
  EXPECT_EQ(uneven.first_code(), "import.kinematics");
  EXPECT_EQ(uneven.first().place.line, 3U);
}

TEST(SettingsImport, a_travel_of_zero_is_no_limit) {
  const Imported it = imported("$100=100\n$110=600\n$120=10\n$130=0\n");
  EXPECT_EQ(it.axis(Axis::x).travel_high, 1e5);
  EXPECT_TRUE(it.warns_of("no upper limit"));
}

}  // namespace
}  // namespace passo::test
