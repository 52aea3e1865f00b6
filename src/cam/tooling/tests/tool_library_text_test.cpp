#include "passo/tooling/tool_library_text.hpp"

#include <gmock/gmock.h>

#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

constexpr const char* every_key = R"([tool.1]
name = "say \"six\" \\ é"
shape = "flat"
diameter_mm = 6
flutes = 3
flute_length_mm = 22
stick_out_mm = 28.5
holder_diameter_mm = 30
centre_cutting = false
material = "hss"
max_rpm = 24000
life_m = 300
life_min = 120
[tool.1.chip_load_mm]
softwood = 0.1
brass = 0.0123

[tool.2]
shape = "bull"
diameter_mm = 6
corner_radius_mm = 0.5
flutes = 2
material = "carbide"

[tool.3]
shape = "taper"
diameter_mm = 6
angle_deg = 12.3
tip_diameter_mm = 1
flutes = 2
material = "carbide"

[tool.4]
shape = "drill"
diameter_mm = 3.175
angle_deg = 118
flutes = 2
material = "carbide"

[tool.5]
shape = "thread-mill"
diameter_mm = 3
neck_diameter_mm = 2.2
reach_mm = 9
tooth_tip_mm = 0.06
teeth = 3
pitch_mm = 0.7
flutes = 3
material = "carbide"
)";

TEST(ToolLibraryText, is_read_and_written_the_same) {
  Diagnostics findings;
  const auto library = ToolLibrary::parse(every_key, "t", findings);
  ASSERT_TRUE(library) << render(findings, false);
  EXPECT_EQ(tool_library_text(library->tools()), every_key);
  EXPECT_EQ(library->tools()[0].life.length, Mm(300'000));
  EXPECT_EQ(library->tools()[0].life.time, Seconds(7200));
  EXPECT_EQ(library->tools()[1].life.length, Mm(0));
}

TEST(ToolLibraryText, begins_with_its_head_as_comments) {
  Diagnostics findings;
  const auto library = ToolLibrary::parse("[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\n", "t", findings);
  const std::string text = tool_library_text(library->tools(), "one\ntwo");
  EXPECT_TRUE(text.starts_with("# one\n# two\n\n[tool.1]\n")) << text;
  EXPECT_TRUE(ToolLibrary::parse(text, "t", findings));
}

TEST(ToolLibraryText, rounds_inches_to_ten_digits) {
  EXPECT_EQ(as_written(0.125 * 25.4), 3.175);
  EXPECT_EQ(as_written(1.0 / 3), 0.3333333333);
}

TEST(ToolLibrary, refuses_a_life_of_nothing) {
  Diagnostics findings;
  EXPECT_FALSE(ToolLibrary::parse("[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\nlife_m = 0\n", "t", findings));
  EXPECT_THAT(render(findings, false), testing::HasSubstr("t:4:"));
}

}  // namespace
}  // namespace passo
