#include "passo/tooling/tool_library.hpp"

#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr const char* workshop = R"([tool.1]
shape = "flat"
diameter_mm = 6
flute_length_mm = 22
holder_diameter_mm = 30
holder_from_mm = 28

[tool.7]
shape = "vee"
diameter_mm = 8
angle_deg = 60

[tool.8]
shape = "bull"
diameter_mm = 6
corner_radius_mm = 1

[tool.9]
shape = "taper"
diameter_mm = 6
tip_diameter_mm = 1
angle_deg = 12

[tool.12]
name = "pilot holes"
shape = "drill"
diameter_mm = 3.2
stick_out_mm = 40
holder_diameter_mm = 20
material = "hss"
max_rpm = 8000

[tool.3]
shape = "ball"
diameter_mm = 3
flutes = 3
centre_cutting = false
[tool.3.chip_load_mm]
plywood = 0.04
)";

TEST(ToolLibrary, has_a_table_for_each_tool) {
  Diagnostics diagnostics;
  const auto library = ToolLibrary::parse(workshop, "tools.toml", diagnostics);
  EXPECT_EQ(render(diagnostics, false), "");
  ASSERT_TRUE(library.has_value());
  EXPECT_EQ(library->numbers(), "T1, T3, T7, T8, T9, T12");
  ASSERT_EQ(library->find(2), nullptr);

  const auto shapes = library->shapes();
  EXPECT_EQ(shapes.at(1).cutter.radius, Mm(3));
  EXPECT_EQ(shapes.at(1).flute_length, Mm(22));
  EXPECT_EQ(shapes.at(1).holder_radius, Mm(15));
  EXPECT_EQ(shapes.at(1).holder_from, Mm(28));
  EXPECT_EQ(shapes.at(7).cutter.kind(), Cutter::Kind::v);
  EXPECT_NEAR(shapes.at(7).cutter.half_angle.value, std::numbers::pi / 6, 1e-12);
  EXPECT_EQ(shapes.at(8).cutter.corner, Mm(1));
  EXPECT_EQ(shapes.at(9).cutter.corner, Mm(0.5));
  EXPECT_EQ(shapes.at(12).holder_from, Mm(40));
  EXPECT_NEAR(shapes.at(12).cutter.half_angle.value, 59 * std::numbers::pi / 180, 1e-12);
}

TEST(ToolLibrary, knows_more_than_the_shape) {
  Diagnostics diagnostics;
  const auto library = ToolLibrary::parse(workshop, "tools.toml", diagnostics);
  ASSERT_TRUE(library.has_value());
  const CuttingTool* const drill = library->find(12);
  ASSERT_NE(drill, nullptr);
  EXPECT_EQ(describe(*drill), "T12 \"pilot holes\", drill, 3.2 mm");
  EXPECT_EQ(describe_without_number(*drill), "pilot holes, drill, 3.2 mm");
  EXPECT_EQ(drill->material, ToolMaterial::hss);
  EXPECT_EQ(drill->most_rpm, 8000);
  const CuttingTool* const ball = library->find(3);
  ASSERT_NE(ball, nullptr);
  EXPECT_EQ(ball->flutes, 3U);
  EXPECT_FALSE(ball->centre_cutting);
  EXPECT_EQ(ball->chip_loads.at(WorkMaterial::plywood), Mm(0.04));
  EXPECT_EQ(library->find(1)->flutes, 2U);
  EXPECT_TRUE(library->find(1)->centre_cutting);
}

TEST(ToolLibrary, gives_the_width_of_the_cut_at_a_depth) {
  Diagnostics diagnostics;
  const auto library = ToolLibrary::parse(workshop, "tools.toml", diagnostics);
  ASSERT_TRUE(library.has_value());
  EXPECT_EQ(diameter_at(*library->find(1), Mm(0.1)), Mm(6));
  EXPECT_NEAR(diameter_at(*library->find(7), Mm(1)).value(), 2 / std::numbers::sqrt3, 1e-9);
  EXPECT_EQ(diameter_at(*library->find(7), Mm(20)), Mm(8));
  EXPECT_NEAR(diameter_at(*library->find(3), Mm(0.5)).value(), 2 * std::sqrt(1.5 * 1.5 - 1), 1e-9);
  EXPECT_EQ(diameter_at(*library->find(3), Mm(1.5)), Mm(3));
}

TEST(ToolLibrary, refuses_invalid_tools) {
  const auto first_of = [](std::string_view text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(ToolLibrary::parse(text, "tools.toml", diagnostics)) << text;
    const Diagnostic& first = diagnostics.all().at(0);
    return fmt::format("{} {}", first.place.line, first.code);
  };
  const std::string flat = "[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\n";
  EXPECT_EQ(first_of(""), "0 tools.missing-key");
  EXPECT_EQ(first_of("tool = 3\n"), "1 tools.wrong-type");
  EXPECT_EQ(first_of("[tool]\n"), "1 tools.tool");
  EXPECT_EQ(first_of("[tool.x]\nshape = \"flat\"\n"), "1 tools.tool");
  EXPECT_EQ(first_of("[tool.T1]\nshape = \"flat\"\n"), "1 tools.tool");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"flat\"\n"), "1 tools.missing-key");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"round\"\ndiameter_mm = 3\n"), "2 tools.shape");
  EXPECT_EQ(first_of(flat + "corner_mm = 1\n"), "4 tools.unknown-key");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"flat\"\ndiameter_mm = -3\n"), "3 tools.out-of-range");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"bull\"\ndiameter_mm = 3\ncorner_radius_mm = 2\n"), "1 tools.tool");
  EXPECT_EQ(first_of("[tool.1\nshape = \"flat\"\n"), "1 tools.syntax");
  EXPECT_EQ(first_of(flat + "flutes = 2.5\n"), "4 tools.out-of-range");
  EXPECT_EQ(first_of(flat + "flutes = 0\n"), "4 tools.out-of-range");
  EXPECT_EQ(first_of(flat + "holder_diameter_mm = 20\n"), "1 tools.missing-key");
  EXPECT_EQ(first_of(flat + "stick_out_mm = 20\nholder_from_mm = 20\n"), "4 tools.both-given");
  EXPECT_EQ(first_of(flat + "material = \"steel\"\n"), "4 tools.material");
  EXPECT_EQ(first_of(flat + "name = \"a) G0 Z-9 (b\"\n"), "4 tools.name");
  EXPECT_EQ(first_of(flat + "[tool.1.chip_load_mm]\nplywod = 0.1\n"), "5 tools.unknown-key");
  EXPECT_EQ(first_of(flat + "[tool.01]\nshape = \"flat\"\ndiameter_mm = 3\n"), "4 tools.duplicate");
}

TEST(ToolLibrary, an_error_shows_the_line_and_the_nearest_key) {
  Diagnostics diagnostics;
  EXPECT_FALSE(
      ToolLibrary::parse("[tool.1]\nshape = \"falt\"\ndiameter_mm = 3\nflute_lenght_mm = 9\n", "my.toml", diagnostics));
  EXPECT_EQ(render(diagnostics, false), R"(my.toml:2:9: error: tool.1.shape is "falt" [tools.shape]
    2 | shape = "falt"
      |         ^~~~~~
      = expected: perhaps flat
my.toml:4:1: error: a tool library has no key tool.1.flute_lenght_mm [tools.unknown-key]
    4 | flute_lenght_mm = 9
      | ^~~~~~~~~~~~~~~
      = expected: perhaps flute_length_mm
2 errors
)");
}

TEST(ToolLibrary, a_tool_number_may_begin_with_T) {
  EXPECT_EQ(parse_tool_number("T3"), 3);
  EXPECT_EQ(parse_tool_number("12"), 12);
  for (const char* const text : {"", "T", "TT3", "-1", "3mm", "100000", "99999999999999999999"}) {
    EXPECT_FALSE(parse_tool_number(text)) << text;
  }
}

}  // namespace
}  // namespace passo
