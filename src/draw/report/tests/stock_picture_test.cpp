#include "passo/report/stock_picture.hpp"

#include <cmath>

#include "stock_shading.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

HeightField bowl() {
  HeightField field = *HeightField::create({{0, 0, -6}, {30, 20, 0}}, Mm(0.5));
  for (std::size_t row = 0; row < field.rows(); ++row) {
    for (std::size_t column = 0; column < field.columns(); ++column) {
      const double away = std::hypot(field.x_of(column) - 15, field.y_of(row) - 10);
      field.set_height(column, row, std::min(0.0, away * away / 16 - 4));
    }
  }
  return field;
}

std::string drawn(const StockDrawing& drawing, PictureFormat format) {
  std::string bytes;
  OutputFile file = OutputFile::into(bytes);
  const PictureOptions options{
      .format = format, .program = "bowl.ngc", .machine = "a bowl", .width = 800, .height = 450};
  EXPECT_TRUE(draw_stock(drawing, options, file).has_value());
  EXPECT_TRUE(file.commit().has_value());
  return bytes;
}

TEST(StockPicture, comes_as_png_and_as_svg) {
  const HeightField field = bowl();
  EXPECT_THAT(drawn({.field = field}, PictureFormat::png), testing::StartsWith("\x89PNG"));
  const std::string svg = drawn({.field = field}, PictureFormat::svg);
  EXPECT_THAT(svg, testing::HasSubstr("<svg"));
  EXPECT_THAT(svg, testing::HasSubstr("data:image/png"));
}

// A wall that nobody paints is as white as the paper: the picture would not change with the height of the stock.
TEST(StockPicture, shows_the_walls_of_the_body) {
  const HeightField field = bowl();
  const StockDrawing drawing{.field = field};
  const StockShading shaded(drawing);
  Projection projection = Projection::isometric();
  Box box;
  box.high[Axis::x] = 30;
  box.high[Axis::y] = 20;
  box.low[Axis::z] = -6;
  const Area area{0, 0, 300, 240};
  projection.fit(box, area);
  const PixelMap map = shaded.as_body(projection, area, 1);
  const Spot front = projection.spot(15, 0, -4);
  const auto place =
      static_cast<std::size_t>(front.y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(front.x);
  EXPECT_EQ(map.pixels[place] >> 24U, 0xFFU);
}

TEST(StockPicture, shows_differences_from_a_target) {
  const HeightField field = bowl();
  HeightField target = bowl();
  for (std::size_t column = 20; column < 30; ++column) {
    for (std::size_t row = 10; row < 20; ++row) target.set_height(column, row, -5);
    for (std::size_t row = 22; row < 30; ++row) target.set_height(column, row, 0);
  }
  const CutTarget even = target_of(field);
  const CutTarget differs = target_of(target);
  const std::string same = drawn({.field = field, .target = &even}, PictureFormat::png);
  const std::string other = drawn({.field = field, .target = &differs}, PictureFormat::png);
  EXPECT_NE(same, other);
}

}  // namespace
}  // namespace passo
