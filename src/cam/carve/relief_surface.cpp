#include "passo/carve/relief_surface.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

struct Sides {
  Mm x;
  Mm y;
};

// `across` by `up`: the size of what is drawn, in any unit.
Sides sides_of(const ReliefShape& shape, double across, double up, Mm usual) {
  if (shape.width && shape.length) return {*shape.width, *shape.length};
  if (shape.length) return {*shape.length * (across / up), *shape.length};
  const Mm width = shape.width.value_or(usual);
  return {width, width * (up / across)};
}

// The surface with nodes no farther apart than wanted, and with the rim.
HeightGrid completed(HeightGrid grid, const ReliefShape& shape, const std::string& name, Diagnostics& diagnostics) {
  const Mm widest = std::max(grid.pitch_x, grid.pitch_y);
  double parts = 1;
  if (shape.pitch) {
    parts = std::max(1.0, std::ceil(widest / *shape.pitch - 1e-9));
  } else if (shape.wished_pitch) {
    const double most =
        std::floor(std::sqrt(static_cast<double>(most_fine_nodes) / static_cast<double>(grid.heights.size())));
    parts = std::max(1.0, std::min(most, std::ceil(widest / *shape.wished_pitch - 1e-9)));
  }
  const double rim_x = std::ceil(shape.margin / grid.pitch_x * parts - 1e-9);
  const double rim_y = std::ceil(shape.margin / grid.pitch_y * parts - 1e-9);
  const double nodes =
      (static_cast<double>(grid.columns) * parts + 2 * rim_x) * (static_cast<double>(grid.rows) * parts + 2 * rim_y);
  if (nodes > static_cast<double>(most_nodes)) {
    diagnostics.add(of_file("relief.too-many-nodes", name,
                            fmt::format("{:.0f} million grid points are too many", nodes / 1e6),
                            "at most 67 million; a greater --pitch or a smaller --margin"));
    return {};
  }
  if (parts > 1) grid = grid.refined(static_cast<std::size_t>(parts));
  if (shape.margin.value() <= 0) return grid;
  const float level = shape.margin_at_top ? 0.0F : floor_of(grid);
  return grid.with_rim(static_cast<std::size_t>(rim_x), static_cast<std::size_t>(rim_y), level);
}

}  // namespace

float floor_of(const HeightGrid& grid) {
  return *std::min_element(grid.heights.begin(), grid.heights.end());
}

HeightGrid relief_of(const LevelPicture& picture, const ReliefShape& shape, const std::string& name,
                     Diagnostics& diagnostics) {
  constexpr Mm usual_width{100};
  constexpr Mm usual_depth{3};
  const auto across = static_cast<double>(picture.columns - 1);
  const auto up = static_cast<double>(picture.rows - 1);
  const Sides sides = sides_of(shape, across, up, usual_width);
  const Mm depth = shape.depth.value_or(usual_depth);
  constexpr std::size_t levels = 65536;
  std::vector<float> height_of(levels);
  for (std::size_t level = 0; level < levels; ++level) {
    const double bright = static_cast<double>(shape.invert ? levels - 1 - level : level) / (levels - 1);
    height_of[level] = grid_height(depth * (std::pow(bright, shape.gamma) - 1));
  }
  HeightGrid grid{
      .columns = picture.columns, .rows = picture.rows, .pitch_x = sides.x / across, .pitch_y = sides.y / up};
  grid.heights.resize(picture.levels.size());
  for (std::size_t y = 0; y < grid.rows; ++y) {
    const std::uint16_t* const from = &picture.levels[(grid.rows - 1 - y) * grid.columns];
    float* const to = &grid.heights[y * grid.columns];
    for (std::size_t x = 0; x < grid.columns; ++x) to[x] = height_of[from[shape.mirror ? grid.columns - 1 - x : x]];
  }
  return completed(std::move(grid), shape, name, diagnostics);
}

HeightGrid relief_of(const Surface& body, const ReliefShape& shape, const std::string& name, Diagnostics& diagnostics) {
  const double across = body.high().x - body.low().x;
  const double up = body.high().y - body.low().y;
  const double high = body.high().z - body.low().z;
  const auto refuse = [&](std::string message, std::string expected) {
    diagnostics.add(of_file("relief.bad-body", name, std::move(message), std::move(expected)));
    return HeightGrid{};
  };
  if (!(across > 1e-6 && up > 1e-6))
    return refuse("the model has no area when seen from above", "a model with faces that are visible from above");
  const Sides sides = sides_of(shape, across, up, Mm(across));
  const Mm depth = shape.depth.value_or(Mm(high * (sides.x.value() / across)));
  if (depth > deepest_relief) {
    return refuse(fmt::format("the model is {:.6g} mm high", depth.value()),
                  "at most 250 mm; check the unit and --depth");
  }
  const Mm pitch = shape.pitch.value_or(std::max(sides.x, sides.y) / 1000);
  const double columns = std::floor(sides.x / pitch + 0.5) + 1;
  const double rows = std::floor(sides.y / pitch + 0.5) + 1;
  if (columns * rows > static_cast<double>(most_nodes)) {
    return refuse(fmt::format("{:.0f} by {:.0f} samples are too many", columns, rows), "a greater --pitch");
  }
  HeightGrid grid{.columns = static_cast<std::size_t>(std::max(2.0, columns)),
                  .rows = static_cast<std::size_t>(std::max(2.0, rows))};
  grid.pitch_x = sides.x / static_cast<double>(grid.columns - 1);
  grid.pitch_y = sides.y / static_cast<double>(grid.rows - 1);
  grid.heights.reserve(grid.columns * grid.rows);
  for (std::size_t y = 0; y < grid.rows; ++y) {
    const double at_y = body.low().y + up * static_cast<double>(y) / static_cast<double>(grid.rows - 1);
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const std::size_t x = shape.mirror ? grid.columns - 1 - i : i;
      const double top =
          body.top(body.low().x + across * static_cast<double>(x) / static_cast<double>(grid.columns - 1), at_y);
      double share = top == Surface::nothing || high <= 0 ? 0 : (top - body.low().z) / high;
      if (shape.invert) share = 1 - share;
      grid.heights.push_back(grid_height(depth * (std::pow(std::clamp(share, 0.0, 1.0), shape.gamma) - 1)));
    }
  }
  ReliefShape sampled = shape;
  sampled.pitch.reset();
  sampled.wished_pitch.reset();
  return completed(std::move(grid), sampled, name, diagnostics);
}

}  // namespace passo
