#include "passo/library/picture.hpp"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo::v1 {
namespace {

Machine drawn_machine() {
  return Machine::open(std::string(PASSO_SOURCE_DIR) + "/examples/machines/pantograph.toml").value();
}

std::size_t pixels_that_are_not_white(const Picture& picture) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    count += picture.rgb[i] != 255 || picture.rgb[i + 1] != 255 || picture.rgb[i + 2] != 255 ? 1 : 0;
  }
  return count;
}

TEST(ToolpathPicture, has_its_size_and_shows_the_path) {
  const Program program = Program::from_text("G21 G90\nG1 X50 F600\nG1 Y40\nM2\n");
  const PictureOptions options{.title = "Corner", .width = 600, .height = 400};
  const Outcome<Picture> picture = draw_toolpath(program, drawn_machine(), options);
  ASSERT_TRUE(picture) << describe(picture.findings().front());
  EXPECT_EQ(picture->width, 600U);
  EXPECT_EQ(picture->height, 400U);
  ASSERT_EQ(picture->rgb.size(), 3U * 600 * 400);
  EXPECT_GT(pixels_that_are_not_white(*picture), 2000U);
  EXPECT_LT(pixels_that_are_not_white(*picture), 600U * 400 / 2);
  EXPECT_THAT(png_of(*picture), testing::StartsWith("\x89PNG"));
}

TEST(ToolpathPicture, refuses_what_is_wrong) {
  const Program program = Program::from_text("G0 X1\nM2\n");
  EXPECT_EQ(draw_toolpath(program, drawn_machine(), {.width = 100'000}).findings().front().code, "picture.size");
  EXPECT_FALSE(draw_toolpath(Program::from_text("G1 X1\nM2\n"), drawn_machine()));
  EXPECT_EQ(png_of({.width = 10, .height = 10, .rgb = {}}), "");
}

TEST(CutStock, is_as_deep_as_the_tool_went) {
  // A slot of 20 mm with a mill of 4 mm, 1 mm deep.
  const Program program = Program::from_text("G21 G90\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F300\nG1 X30\nG0 Z5\nM2\n");
  StockOptions options;
  options.tool = MillingTool{.kind = MillingTool::Kind::flat, .diameter_mm = 4};
  options.x_mm = AxisRange{0, 40};
  options.y_mm = AxisRange{0, 20};
  options.z_mm = AxisRange{-5, 0};
  options.cell_mm = 0.1;
  const Outcome<Stock> stock = cut_stock(program, options);
  ASSERT_TRUE(stock) << describe(stock.findings().front());
  EXPECT_TRUE(stock.findings().empty());
  EXPECT_EQ(stock->columns, 400U);
  EXPECT_EQ(stock->rows, 200U);
  ASSERT_EQ(stock->below_top_mm.size(), 400U * 200);
  const auto height = [&](double x, double y) {
    return stock->below_top_mm[static_cast<std::size_t>(y / 0.1) * stock->columns + static_cast<std::size_t>(x / 0.1)];
  };
  EXPECT_NEAR(height(20, 10), -1, 1e-5);
  EXPECT_NEAR(height(20, 11.8), -1, 1e-5);
  EXPECT_EQ(height(20, 12.3), 0);
  EXPECT_NEAR(stock->removed_mm3, 20 * 4 + 3.14159 * 4, 1.5);
  const Outcome<Picture> picture = draw_stock(*stock, {.title = "Slot", .width = 600, .height = 400});
  ASSERT_TRUE(picture);
  EXPECT_GT(pixels_that_are_not_white(*picture), 20'000U);
}

TEST(CutStock, tells_troubles_and_refuses_what_is_wrong) {
  const Program program = Program::from_text("G21 G90\nG1 Z-1 F300\nG0 X30\nM2\n");
  StockOptions options;
  EXPECT_EQ(cut_stock(program, options).findings().front().code, "simulate.no-tool");
  options.tool = MillingTool{.kind = MillingTool::Kind::vee, .diameter_mm = 6, .included_angle_deg = 60};
  options.x_mm = AxisRange{-5, 40};
  options.y_mm = AxisRange{-5, 5};
  options.z_mm = AxisRange{-5, 0};
  const Outcome<Stock> rapid = cut_stock(program, options);
  ASSERT_TRUE(rapid);
  EXPECT_FALSE(rapid.findings().empty());  // a rapid move through the stock
  options.tool->diameter_mm = -1;
  EXPECT_EQ(cut_stock(program, options).findings().front().code, "stock.option");
  options.tool->diameter_mm = 6;
  options.x_mm = AxisRange{5, -5};
  EXPECT_EQ(cut_stock(program, options).findings().front().code, "stock.option");
}

}  // namespace
}  // namespace passo::v1
