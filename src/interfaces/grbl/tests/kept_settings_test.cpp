// Settings that senders change, in the text of a machine file.
#include "passo/grbl/kept_settings.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "passo/grbl/grbl_settings.hpp"

namespace passo {
namespace {

std::string example_text(const std::string& name) {
  std::ifstream file(PASSO_SOURCE_DIR "/examples/machines/" + name + ".toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::optional<MachineDescription> parse(const std::string& text) {
  Diagnostics diagnostics;
  return parse_machine(text, "a test", diagnostics);
}

std::string value_of(const KeptSettings& kept, int number) {
  for (const GrblSetting& setting : grbl_settings(kept.machine(), {})) {
    if (setting.number == number) return setting.value;
  }
  return "";
}

// The lines that differ, one below the other.
std::string changed_lines(const std::string& before, const std::string& after) {
  std::istringstream a(before);
  std::istringstream b(after);
  std::string lines;
  for (std::string x, y; std::getline(a, x) && std::getline(b, y);) {
    if (x != y) lines += y + "\n";
  }
  return lines;
}

TEST(KeptSettings, change_one_line_each_and_keep_its_comment) {
  const std::string text = example_text("router");
  struct Case {
    int number;
    double value;
    const char* shown;
    const char* lines;
  };
  for (const Case& one : {Case{100, 800, "800.000", "screw_pitch_mm = 4          # 640 microsteps/mm\n"},
                          Case{110, 4800, "4800.000", "max_velocity_mm_s = 80      # 1200 rpm\n"},
                          Case{121, 550, "550.000", "max_acceleration_mm_s2 = 550  # this axis moves the gantry\n"},
                          Case{11, 0.05, "0.050", "path_tolerance_mm = 0.05\n"}}) {
    KeptSettings kept(text);
    std::string reason;
    const auto after = kept.with(one.number, one.value, reason);
    ASSERT_TRUE(after) << one.number << reason;
    EXPECT_EQ(changed_lines(text, *after), one.lines);
    kept.set_text(*after);
    EXPECT_EQ(value_of(kept, one.number), one.shown);
  }
}

TEST(KeptSettings, of_pins_directions_and_the_spindle_are_lines_of_their_tables) {
  const std::string text = example_text("router");
  struct Case {
    int number;
    double value;
    const char* line;
  };
  for (const Case& one : {Case{0, 5, "step_pulse_us = 5\n"}, Case{2, 7, "step = \"low\"\n"},
                          Case{3, 2, "inverted = true\n"}, Case{4, 1, "driver_enable = \"high\"\n"},
                          Case{6, 1, "probe = \"high\"\n"}, Case{30, 18'000, "max_rpm = 18000\n"}}) {
    KeptSettings kept(text);
    std::string reason;
    const auto after = kept.with(one.number, one.value, reason);
    ASSERT_TRUE(after) << one.number << reason;
    EXPECT_NE(after->find(one.line), std::string::npos) << *after;
    EXPECT_TRUE(has_setting(*parse(*after), {}, one.number, one.value)) << one.number;
  }
  // Only all drivers at once, and only axes that are there.
  for (const auto& [number, value] : {std::pair{2, 3.0}, {3, 8.0}, {3, 300.0}, {4, 2.0}, {30, 70'000.0}}) {
    std::string reason;
    EXPECT_FALSE(KeptSettings(text).with(number, value, reason)) << number;
  }
}

TEST(KeptSettings, keep_the_end_of_the_travel_that_has_the_switch) {
  const std::string text = example_text("router");
  KeptSettings kept(text);
  std::string reason;
  EXPECT_EQ(changed_lines(text, kept.with(130, 700, reason).value_or("")), "travel_mm = [-400, 300]\n");
  EXPECT_EQ(changed_lines(text, kept.with(132, 100, reason).value_or("")), "travel_mm = [-40, 60]\n");
}

TEST(KeptSettings, of_homing_are_those_of_all_axes) {
  const std::string text = example_text("router");
  KeptSettings kept(text);
  std::string reason;
  EXPECT_EQ(changed_lines(text, kept.with(25, 1200, reason).value_or("")),
            "seek_mm_s = 20\nseek_mm_s = 20\nseek_mm_s = 20\n");
}

TEST(KeptSettings, refuse_what_the_file_does_not_have_and_what_is_not_sound) {
  const KeptSettings kept(example_text("router"));
  for (const int number : {1, 5, 12, 20, 23, 31, 99, 103, 109, 113, 140, 200, -1, 1000000}) {
    std::string reason;
    EXPECT_FALSE(kept.with(number, 1, reason)) << number;
    EXPECT_NE(reason, "") << number;
  }
  for (const auto& [number, value] : {std::pair{100, 0.0},
                                      {100, 1e12},
                                      {110, 0.0},
                                      {110, 1e9},
                                      {130, 0.0},
                                      {130, 1e9},
                                      {24, 1e9},
                                      {11, 0.0},
                                      {120, 1e-9}}) {
    std::string reason;
    EXPECT_FALSE(kept.with(number, value, reason)) << number << " " << value;
  }
}

}  // namespace
}  // namespace passo
