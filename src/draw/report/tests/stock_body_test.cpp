#include "passo/report/stock_body.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

namespace passo {
namespace {

using BodyCorner = std::array<float, 3>;
using BodyTriangle = std::array<BodyCorner, 3>;

HeightField body_field() {
  HeightField field = *HeightField::create({{1, 2, -4}, {4, 4.5, 0}}, Mm(0.25));
  for (std::size_t row = 0; row < field.rows(); ++row) {
    for (std::size_t column = 0; column < field.columns(); ++column) {
      field.set_height(column, row,
                       -1 - std::sin(0.4 * static_cast<double>(column)) * std::cos(0.3 * static_cast<double>(row)));
    }
  }
  return field;
}

std::vector<BodyTriangle> triangles_in(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  EXPECT_EQ(bytes.size(), 84 + std::size_t{count} * 50);
  std::vector<BodyTriangle> triangles(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(triangles[i].data(), bytes.data() + 84 + i * 50 + 12, sizeof(BodyTriangle));
  }
  return triangles;
}

// Each edge is there once in each direction, so the body has no hole.
void expect_closed(const std::vector<BodyTriangle>& triangles) {
  std::map<std::pair<BodyCorner, BodyCorner>, int> edges;
  for (const BodyTriangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_TRUE(back != edges.end() && back->second == count)
        << edge.first[0] << " " << edge.first[1] << " " << edge.first[2];
  }
}

double volume_of(const std::vector<BodyTriangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const auto d = [](float value) { return static_cast<double>(value); };
    sum += d(a[0]) * (d(b[1]) * d(c[2]) - d(b[2]) * d(c[1])) - d(a[1]) * (d(b[0]) * d(c[2]) - d(b[2]) * d(c[0])) +
           d(a[2]) * (d(b[0]) * d(c[1]) - d(b[1]) * d(c[0]));
  }
  return sum / 6;
}

std::vector<BodyTriangle> written(const HeightField& field, std::size_t step, const WallHeights& walls = {}) {
  std::string bytes;
  OutputFile file = OutputFile::into(bytes);
  const std::uint64_t count = write_stock_body(field, step, walls, file);
  EXPECT_TRUE(file.commit().has_value());
  const std::vector<BodyTriangle> triangles = triangles_in(bytes);
  EXPECT_EQ(triangles.size(), count);
  return triangles;
}

TEST(StockBody, is_closed_and_has_the_volume_of_the_field) {
  const HeightField field = body_field();
  for (const std::size_t step : {1U, 3U, 100U}) expect_closed(written(field, step));
  EXPECT_NEAR(volume_of(written(field, 1)), field.volume(), 0.01 * field.volume());
}

TEST(StockBody, has_a_hole_where_the_stock_is_cut_through) {
  HeightField field = body_field();
  for (std::size_t row = 3; row < 7; ++row) {
    for (std::size_t column = 0; column < 5; ++column) field.set_height(column, row, -4);
  }
  const std::vector<BodyTriangle> triangles = written(field, 1);
  expect_closed(triangles);
  for (const BodyTriangle& triangle : triangles) {
    const bool is_inside = triangle[0][0] < 2.1F && triangle[1][0] < 2.1F && triangle[2][0] < 2.1F &&
                           triangle[0][1] > 2.8F && triangle[1][1] > 2.8F && triangle[2][1] > 2.8F &&
                           triangle[0][1] < 3.6F && triangle[1][1] < 3.6F && triangle[2][1] < 3.6F;
    EXPECT_FALSE(is_inside);
  }
}

// A round pocket: its wall runs in all directions.
TEST(StockBody, is_closed_at_walls_and_has_their_heights) {
  constexpr double radius = 1.03;
  constexpr double depth = 2;
  const auto height = [&](double x, double y) { return std::hypot(x - 2.5, y - 3.2) < radius ? -depth : 0.0; };
  for (const double bottom : {-4.0, -depth}) {
    HeightField field = *HeightField::create({{1, 2, bottom}, {4, 4.5, 0}}, Mm(0.25));
    for (std::size_t row = 0; row < field.rows(); ++row) {
      for (std::size_t column = 0; column < field.columns(); ++column) {
        field.set_height(column, row, height(field.x_of(column), field.y_of(row)));
      }
    }
    WallHeights walls = WallHeights::at_walls_of(field, 1);
    for (WallHeights::Patch& patch : walls.patches()) {
      HeightField& points = patch.heights;
      for (std::size_t row = 0; row < points.rows(); ++row) {
        for (std::size_t column = 0; column < points.columns(); ++column) {
          points.set_height(column, row, height(points.x_of(column), points.y_of(row)));
        }
      }
    }
    const double exact = 3 * 2.5 * -bottom - std::numbers::pi * radius * radius * depth;
    const std::vector<BodyTriangle> triangles = written(field, 1, walls);
    expect_closed(triangles);
    EXPECT_NEAR(volume_of(triangles), exact, 0.05);
    EXPECT_GT(std::abs(volume_of(written(field, 1)) - exact), 0.05);
  }
}

}  // namespace
}  // namespace passo
