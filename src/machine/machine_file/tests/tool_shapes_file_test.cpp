#include "passo/machine_file/tool_shapes_file.hpp"

#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(ToolShapesFile, has_a_table_for_each_tool) {
  Diagnostics diagnostics;
  const auto tools = parse_tool_shapes(R"([tool.1]
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
)",
                                       "tools.toml", diagnostics);
  EXPECT_EQ(render(diagnostics, false), "");
  ASSERT_TRUE(tools.has_value());
  ASSERT_EQ(tools->size(), 4U);
  EXPECT_EQ(tools->at(1).cutter.radius, Mm(3));
  EXPECT_EQ(tools->at(1).flute_length, Mm(22));
  EXPECT_EQ(tools->at(1).holder_radius, Mm(15));
  EXPECT_EQ(tools->at(1).holder_from, Mm(28));
  EXPECT_EQ(tools->at(7).cutter.kind(), Cutter::Kind::v);
  EXPECT_NEAR(tools->at(7).cutter.half_angle.value, std::numbers::pi / 6, 1e-12);
  EXPECT_EQ(tools->at(8).cutter.corner, Mm(1));
  EXPECT_EQ(tools->at(9).cutter.corner, Mm(0.5));
}

TEST(ToolShapesFile, refuses_what_is_no_tool) {
  const auto first_of = [](std::string_view text) {
    Diagnostics diagnostics;
    EXPECT_FALSE(parse_tool_shapes(text, "tools.toml", diagnostics)) << text;
    const Diagnostic& first = diagnostics.all().at(0);
    return fmt::format("{} {}", first.place.line, first.code);
  };
  EXPECT_EQ(first_of(""), "0 tools.missing-key");
  EXPECT_EQ(first_of("tool = 3\n"), "1 tools.wrong-type");
  EXPECT_EQ(first_of("[tool.x]\nshape = \"flat\"\n"), "1 tools.tool");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"flat\"\n"), "1 tools.missing-key");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"round\"\ndiameter_mm = 3\n"), "2 tools.shape");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\ncorner_mm = 1\n"), "4 tools.unknown-key");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"flat\"\ndiameter_mm = -3\n"), "3 tools.out-of-range");
  EXPECT_EQ(first_of("[tool.1]\nshape = \"bull\"\ndiameter_mm = 3\ncorner_radius_mm = 2\n"), "1 tools.tool");
  EXPECT_EQ(first_of("[tool.1\nshape = \"flat\"\n"), "1 tools.syntax");
}

}  // namespace
}  // namespace passo
