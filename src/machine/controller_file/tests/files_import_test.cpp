// FluidNC's YAML, LinuxCNC's ini, Mach3's XML, and files that mean harm.
#include <cstdlib>
#include <filesystem>

#include "imported.hpp"
#include <gtest/gtest.h>

namespace passo::test {
namespace {

TEST(FluidNcImport, keeps_numbers_travel_and_homing) {
  const Imported it = imported_example("fluidnc.yaml");
  EXPECT_EQ(it.machine->name, "Router, with a gantry");
  const AxisDescription& x = it.axis(Axis::x);
  EXPECT_EQ(x.steps_per_unit, 200);
  EXPECT_EQ(x.velocity.value(), 100);
  EXPECT_EQ(x.acceleration.value(), 450.5);
  EXPECT_EQ(x.travel_low, 0);
  EXPECT_EQ(x.travel_high, 320);
  EXPECT_TRUE(x.inverted);
  EXPECT_EQ(x.home->switch_at, -2.5);
  EXPECT_EQ(x.home->rest(), 0);
  const AxisDescription& y = it.axis(Axis::y);
  EXPECT_EQ(y.travel_low, -10);
  EXPECT_EQ(y.travel_high, 690);
  EXPECT_TRUE(y.home->toward_high);
  ASSERT_TRUE(y.second.has_value());
  EXPECT_TRUE(y.second->inverted);
  EXPECT_FALSE(y.inverted);
  EXPECT_FALSE(it.axis(Axis::z).home.has_value());
  EXPECT_EQ(it.axis(Axis::z).travel_low, -90);
}

TEST(FluidNcImport, pins_are_active_high_unless_they_say_low) {
  const Imported it = imported_example("fluidnc.yaml");
  const PinsDescription& pins = it.machine->pins;
  EXPECT_FALSE(pins.limits_high[0]);
  EXPECT_TRUE(pins.limits_high[1]);
  EXPECT_TRUE(pins.limits_high[3]);  // the second motor of Y
  EXPECT_TRUE(pins.probe_high);
  EXPECT_FALSE(pins.feed_hold_high);
  EXPECT_FALSE(pins.door_high);
  EXPECT_TRUE(pins.mist_low);
  EXPECT_FALSE(pins.flood_low);
  EXPECT_FALSE(pins.driver_enable_high);
  EXPECT_EQ(it.machine->tool.highest_rpm, 24000);
  EXPECT_DOUBLE_EQ(it.machine->spindle.run_up.value(), 0.125);
  const Imported relay = imported(replaced(example_text("fluidnc.yaml"), "PWM:", "Relay:"));
  EXPECT_EQ(relay.machine->tool.highest_rpm, 0);
  EXPECT_EQ(relay.reason_of("Relay/speed_map"), "a relay has no speeds");
  EXPECT_EQ(it.reason_of("future_section/what"), "");
  EXPECT_TRUE(it.warns_of("soft limits of axis Y"));
}

TEST(FluidNcImport, refuses_other_kinematics_and_what_is_not_yaml) {
  const std::string text = example_text("fluidnc.yaml");
  const Imported corexy = imported(replaced(text, "axes:", "kinematics:\n  corexy:\naxes:"));
  EXPECT_EQ(corexy.first_code(), "import.kinematics");
  EXPECT_NE(corexy.first().message.find("corexy"), std::string::npos);
  EXPECT_TRUE(imported(replaced(text, "axes:", "kinematics:\n  Cartesian:\naxes:")).machine.has_value());
  const Imported open = imported(replaced(text, "name: \"Router", "name: [\"Router"));
  EXPECT_EQ(open.first_code(), "import.syntax");
  EXPECT_GT(open.first().place.line, 0U);
  EXPECT_EQ(imported(replaced(text, "steps_per_mm: 200", "steps_per_mm: many")).first_code(), "import.not-a-number");
}

TEST(FluidNcImport, needs_no_blank_after_a_colon_as_fluidnc_does) {
  const std::string text = example_text("fluidnc.yaml");
  const Imported it = imported(replaced(text, "pulloff_mm: 2.5", "pulloff_mm:2.5"));
  EXPECT_EQ(it.axis(Axis::x).home->pull_off, 2.5);
  EXPECT_EQ(it.result->toml, imported(text).result->toml);
  const Imported wrong = imported(replaced(text, "max_travel_mm: 320", "max_travel_mm:all"));
  ASSERT_EQ(wrong.first_code(), "import.not-a-number");
  EXPECT_EQ(wrong.first().text, "    max_travel_mm:all");
  EXPECT_EQ(wrong.first().place.column, 19U);
}

TEST(LinuxCncImport, keeps_numbers_homing_and_the_gantry) {
  const Imported it = imported_example("linuxcnc.ini");
  EXPECT_EQ(it.machine->name, "Mill with a gantry");
  const AxisDescription& x = it.axis(Axis::x);
  EXPECT_EQ(x.steps_per_unit, 160.5);
  EXPECT_TRUE(x.inverted);            // a negative SCALE
  EXPECT_EQ(x.velocity.value(), 80);  // of the axis; the joint can do 90
  EXPECT_EQ(x.acceleration.value(), 450);
  EXPECT_EQ(x.travel_low, -0.5);
  EXPECT_EQ(x.screw->backlash, 0.04);
  EXPECT_EQ(x.home->switch_at, -0.5);
  EXPECT_EQ(x.home->pull_off, 1.5);  // HOME - HOME_OFFSET
  EXPECT_FALSE(x.home->toward_high);
  ASSERT_TRUE(it.axis(Axis::y).second.has_value());
  EXPECT_TRUE(it.axis(Axis::y).second->inverted);
  EXPECT_FALSE(it.axis(Axis::y).inverted);
  EXPECT_EQ(it.machine->homing, (std::vector<Axis>{Axis::z, Axis::x}));
  EXPECT_DOUBLE_EQ(it.machine->board.step_pulse.value(), 5e-6);  // the longest of all joints
  EXPECT_DOUBLE_EQ(it.machine->board.direction_hold.value(), 12e-6);
  EXPECT_EQ(it.machine->tool.highest_rpm, 18000);
  EXPECT_EQ(it.reason_of("[JOINT_0]STEPGEN_MAXACCEL"), "headroom of LinuxCNC's step generator: Passo needs none");
}

TEST(LinuxCncImport, inches_become_exact_millimetres) {
  const Imported it = imported_example("linuxcnc_inch.ini");  // [AXIS_2] of a lathe, as before 2.8
  EXPECT_EQ(it.axis(Axis::x).steps_per_unit, 100);
  EXPECT_EQ(it.axis(Axis::x).velocity.value(), 38.1);
  EXPECT_EQ(it.axis(Axis::z).travel_low, -254);
  EXPECT_EQ(it.axis(Axis::z).travel_high, 2.54);
  EXPECT_EQ(it.axis(Axis::a).velocity.value(), 90);  // degrees stay degrees
  EXPECT_EQ(it.axis(Axis::a).travel_low, -1e7);
  EXPECT_TRUE(it.warns_of("inches"));
}

TEST(LinuxCncImport, refuses_other_kinematics_units_and_scales) {
  const std::string text = example_text("linuxcnc.ini");
  EXPECT_EQ(imported(replaced(text, "trivkins", "corexykins")).first_code(), "import.kinematics");
  EXPECT_EQ(imported(replaced(text, "LINEAR_UNITS = mm", "LINEAR_UNITS = cubit")).first_code(), "import.units");
  EXPECT_EQ(imported(replaced(text, "LINEAR_UNITS = mm", "")).first_code(), "import.units");
  EXPECT_EQ(imported(replaced(text, "SCALE = -160.5\n[AXIS_Z]", "SCALE = -161\n[AXIS_Z]")).first_code(),
            "import.scale");
  EXPECT_EQ(imported(replaced(text, "coordinates=XYYZ", "coordinates=XYYY")).first_code(), "import.too-many-motors");
  EXPECT_EQ(imported(replaced(text, "SCALE = 800", "")).first_code(), "import.missing-key");
  EXPECT_EQ(imported(replaced(text, "MAX_LIMIT = 5", "MAX_LIMIT = -500")).first_code(), "import.travel");
  const Imported name = imported(replaced(text, "SCALE = 800", "SCALE = eight"));
  EXPECT_EQ(name.first_code(), "import.not-a-number");
  EXPECT_EQ(name.first().text, "SCALE = eight");
  EXPECT_EQ(name.first().place.column, 9U);
}

TEST(Mach3Import, keeps_numbers_units_and_directions) {
  const Imported it = imported_example("mach3.xml");  // inches
  EXPECT_EQ(it.axis(Axis::x).steps_per_unit, 100);
  EXPECT_EQ(it.axis(Axis::x).velocity.value(), 38.1);
  EXPECT_EQ(it.axis(Axis::x).acceleration.value(), 254);
  EXPECT_EQ(it.axis(Axis::x).travel_low, -304.8);
  EXPECT_TRUE(it.axis(Axis::x).inverted);
  EXPECT_TRUE(it.axis(Axis::z).inverted);  // reversed twice, and negative steps
  EXPECT_EQ(it.axis(Axis::x).screw->backlash, 0.0254);
  EXPECT_EQ(it.axis(Axis::a).steps_per_unit, 50);
  EXPECT_EQ(it.machine->axes.size(), 3U);
  EXPECT_NE(it.reason_of("RefSpeed0").find("[axis.X.home]"), std::string::npos);
  const Imported slaved = imported(replaced(example_text("mach3.xml"), "<Slave>-1", "<Slave>3"));
  EXPECT_EQ(slaved.machine->axes.size(), 2U);
  EXPECT_TRUE(slaved.axis(Axis::x).second.has_value());
}

TEST(ControllerFile, refuses_files_that_mean_harm) {
  EXPECT_EQ(imported(example_text("laughs.xml")).first_code(), "import.syntax");
  EXPECT_EQ(imported(example_text("laughs.yaml")).first_code(), "import.too-large");
  EXPECT_EQ(imported(example_text("itself.yaml")).first_code(), "import.too-large");
  EXPECT_EQ(imported(std::string(most_source_bytes + 1, '\n'), ImportFormat::fluidnc).first_code(), "import.too-large");
  EXPECT_EQ(imported(std::string("$100=1\0", 7)).first_code(), "import.binary");
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<profile>";
  EXPECT_EQ(imported(deep).first_code(), "import.too-large");
  EXPECT_EQ(imported("axes: " + std::string(5000, '[')).first_code(), "import.syntax");
  std::string sections = "[TRAJ]\n";
  for (int i = 0; i < 5000; ++i) sections += "[S" + std::to_string(i) + "]\n";
  EXPECT_EQ(imported(sections).first_code(), "import.syntax");
  Diagnostics diagnostics;
  EXPECT_FALSE(import_controller_file("/nonexistent", {}, diagnostics).has_value());
  EXPECT_EQ(diagnostics.all().front().code, "import.unreadable");
}

TEST(ControllerFile, a_name_cannot_break_out_of_its_quotes) {
  const std::string text =
      replaced(example_text("linuxcnc.ini"), "Mill with a gantry", "a\"\\\n[axis.Q]\n\x01\xff\xc3\xa9 \"");
  const Imported it = imported(text);
  ASSERT_TRUE(it.machine.has_value());
  EXPECT_EQ(it.machine->name, "a\"\\");
  const Imported other =
      imported(replaced(example_text("linuxcnc.ini"), "Mill with a gantry", "x\x01\xff\xc3\xa9\" # = y"));
  EXPECT_EQ(other.machine->name, "x??\xc3\xa9\" # = y");
}

// Each key of an example is in the report.
TEST(ControllerFile, lists_every_value_of_the_source) {
  for (const char* name : {"grbl.txt", "grblhal.txt", "fluidnc.yaml", "linuxcnc.ini", "linuxcnc_inch.ini"}) {
    const Imported it = imported_example(name);
    Diagnostics none;
    const auto tree = read_source_tree(it.result->format, {.file = name, .text = example_text(name)}, none);
    const auto check = [&](const SourceNode& node, auto&& self) -> void {
      const bool is_group = node.text.ends_with("keys");
      if (node.children.empty() && node.line > 0 && !is_group && !node.text.empty() && node.text != "NO_PIN" &&
          (node.name.starts_with('$') || it.result->format != ImportFormat::settings)) {
        const auto is_here = [&](const auto& value) { return value.line == node.line; };
        EXPECT_TRUE(std::ranges::any_of(it.result->understood, is_here) ||
                    std::ranges::any_of(it.result->unmapped, is_here))
            << name << ":" << node.line << ": " << node.name;
      }
      const bool is_summary = std::ranges::any_of(it.result->unmapped, [&](const UnmappedValue& value) {
        return value.line == node.line && value.value.ends_with(" keys");
      });
      for (const SourceNode& child : node.children) {
        if (!is_summary) self(child, self);
      }
    };
    check(*tree, check);
  }
}

// Each number of the machine file has its source beside it, or says that it is assumed.
TEST(ControllerFile, every_value_of_the_machine_file_has_a_source) {
  for (const char* name :
       {"grbl.txt", "grblhal.txt", "fluidnc.yaml", "linuxcnc.ini", "linuxcnc_inch.ini", "mach3.xml"}) {
    const Imported it = imported_example(name);
    std::string_view text = it.result->toml;
    while (!text.empty()) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(line.size() + 1);
      if (line.find(" = ") == std::string_view::npos || line.starts_with('#')) continue;
      EXPECT_NE(line.find(" # "), std::string_view::npos) << name << ": " << line;
    }
  }
}

// Configurations of LinuxCNC that others have written, where they are at hand.
TEST(ControllerFile, maps_the_sample_configurations_of_linuxcnc) {
  const std::filesystem::path samples = PASSO_SOURCE_DIR "/../shared/peers/linuxcnc";
  if (!std::filesystem::is_directory(samples)) GTEST_SKIP() << "no folder " << samples;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(samples)) {
    if (entry.path().extension() != ".ini") continue;
    Diagnostics diagnostics;
    const auto machine = import_controller_file(entry.path(), {}, diagnostics);
    EXPECT_NE(machine.has_value(), diagnostics.any_error()) << entry.path();
    for (const Diagnostic& finding : diagnostics.all()) EXPECT_NE(finding.code, "import.bad-result") << entry.path();
  }
}

}  // namespace
}  // namespace passo::test
