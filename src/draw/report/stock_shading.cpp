#include "stock_shading.hpp"

#include <algorithm>
#include <cmath>

#include "passo/stock/field_comparison.hpp"

namespace passo {
namespace {

// Towards the light: from the upper left, and above.
const Vector3 light = Vector3{-0.45, 0.45, 0.77} / length(Vector3{-0.45, 0.45, 0.77});
constexpr double dark = 0.42;        // what a face away from the light keeps of its colour
constexpr double wall_share = 0.55;  // a wall's, seen from the side

Colour mixed(const Colour& a, const Colour& b, double share) {
  const auto mix = [&](double from, double to) { return from + (to - from) * share; };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

std::size_t nearest_cell(double place, std::size_t cells) {
  return static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(cells) - 1));
}

}  // namespace

std::uint32_t pixel_of(const Colour& colour, double bright) {
  const auto channel = [&](double part) {
    return static_cast<std::uint32_t>(std::lround(255 * std::clamp(part * bright, 0.0, 1.0)));
  };
  return 0xFF000000U | channel(colour.red) << 16U | channel(colour.green) << 8U | channel(colour.blue);
}

StockShading::StockShading(const StockDrawing& drawing) : drawing_(drawing) {
  const HeightField& field = drawing.field;
  for (std::size_t row = 0; row < field.rows(); ++row) {
    const float* const cells = field.below_top(row);
    deepest_ = std::max(deepest_, -static_cast<double>(*std::min_element(cells, cells + field.columns())));
    if (drawing.target == nullptr) continue;
    for (std::size_t column = 0; column < field.columns(); ++column) {
      const double difference = cell_difference(field, *drawing.target, column, row);
      left_ = std::max(left_, difference);
      gouge_ = std::max(gouge_, -difference);
    }
  }
}

Colour StockShading::colour_of_depth(double depth) const {
  constexpr double untouched = 1e-4;
  if (depth <= untouched || !(deepest_ > 0)) return untouched_colour;
  return SpeedColours::at(depth / deepest_);
}

Colour StockShading::colour_of_difference(double difference) const {
  const double size = std::abs(difference);
  if (size <= drawing_.tolerance.value()) return even_colour;
  const double largest = difference > 0 ? left_ : gouge_;
  // Small differences are to be seen, too.
  const double share = largest > 0 ? 0.35 + 0.65 * std::min(1.0, size / largest) : 1;
  return mixed(even_colour, difference > 0 ? left_colour : gouge_colour, share);
}

double StockShading::height_near(double column, double row) const {
  return drawing_.field.height(nearest_cell(column, drawing_.field.columns()),
                               nearest_cell(row, drawing_.field.rows()));
}

// `size`: of the patch, in cells.
StockShading::Patch StockShading::patch(double column, double row, double size) const {
  const HeightField& field = drawing_.field;
  const double away = std::max(1.0, size / 2);
  const double mm = 2 * away * field.cell();
  const double slope_x = (height_near(column + away, row) - height_near(column - away, row)) / mm;
  const double slope_y = (height_near(column, row + away) - height_near(column, row - away)) / mm;
  const Vector3 normal{-slope_x, -slope_y, 1};
  const double towards = dot(normal, light) / length(normal);
  const double bright = dark + (1.12 - dark) * std::max(0.0, towards) / light.z;
  Patch patch;
  patch.height = height_near(column, row);
  Colour colour = colour_of_depth(field.top() - patch.height);
  if (drawing_.target != nullptr) {
    colour = colour_of_difference(cell_difference(field, *drawing_.target, nearest_cell(column, field.columns()),
                                                  nearest_cell(row, field.rows())));
  }
  patch.colour = pixel_of(colour, bright);
  patch.wall = pixel_of(colour, wall_share);
  return patch;
}

PixelMap StockShading::from_above(int width, int height) const {
  const HeightField& field = drawing_.field;
  PixelMap map{width, height, {}};
  map.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const double across = static_cast<double>(field.columns()) / width;
  const double up = static_cast<double>(field.rows()) / height;
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      map.pixels.push_back(patch((x + 0.5) * across, (y + 0.5) * up, across).colour);
    }
  }
  return map;
}

// From the back to the front: each piece of the face with the wall below it covers what is behind.
PixelMap StockShading::as_body(const Projection& projection, const Area& area, int scale) const {
  const HeightField& field = drawing_.field;
  PixelMap map{static_cast<int>(area.width) * scale, static_cast<int>(area.height) * scale, {}};
  map.pixels.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), 0);
  constexpr double most_pieces = 1400;
  const double pieces_x = std::min(most_pieces, static_cast<double>(field.columns()));
  const double pieces_y = std::min(most_pieces, static_cast<double>(field.rows()));
  const double across = static_cast<double>(field.columns()) / pieces_x;
  const double up = static_cast<double>(field.rows()) / pieces_y;
  const auto pixel_at = [&](double x, double y, double z) {
    const Spot spot = projection.spot(x, y, z);
    return Spot{(spot.x - area.x) * scale, (spot.y - area.y) * scale};
  };
  // A piece is a rhombus; the strip that stands for it is as wide.
  const Spot zero = pixel_at(0, 0, 0);
  const Spot one = pixel_at(across * field.cell(), up * field.cell(), 0);
  const double half_width = 0.5 * (one.x - zero.x) + 0.5;
  for (double j = pieces_y - 1; j >= 0; --j) {
    for (double i = 0; i < pieces_x; ++i) {
      const Patch piece = patch((i + 0.5) * across, (j + 0.5) * up, across);
      if (piece.height <= field.bottom()) continue;
      const double x = field.block().low.x + (i + 0.5) * across * field.cell();
      const double y = field.block().low.y + (j + 0.5) * up * field.cell();
      const Spot top = pixel_at(x, y, piece.height);
      const Spot foot = pixel_at(x, y, field.bottom());
      const int from_x = std::max(0, static_cast<int>(std::floor(top.x - half_width)));
      const int to_x = std::min(map.width - 1, static_cast<int>(std::floor(top.x + half_width)));
      const int from_y = std::max(0, static_cast<int>(std::floor(top.y)));
      const int face_y = static_cast<int>(std::ceil(top.y + half_width));
      const int to_y = std::min(map.height - 1, static_cast<int>(std::ceil(foot.y)));
      for (int row = from_y; row <= to_y; ++row) {
        const std::uint32_t colour = row <= face_y ? piece.colour : piece.wall;
        const std::size_t line = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width);
        for (int column = from_x; column <= to_x; ++column)
          map.pixels[line + static_cast<std::size_t>(column)] = colour;
      }
    }
  }
  return map;
}

}  // namespace passo
