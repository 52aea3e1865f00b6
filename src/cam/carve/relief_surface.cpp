#include "passo/carve/relief_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "body_grid.hpp"
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
  if (shape.lowest) {
    const float lowest = grid_height(-*shape.lowest);
    for (float& height : grid.heights) height = std::max(height, lowest);
  }
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

namespace {

// Smooths a line of `count` levels, at a stride of `apart`, by a Gaussian of `sigma` pixels. Beyond its ends, the line
// is extended.
class LineSmoother {
 public:
  explicit LineSmoother(double sigma) {
    const auto reach = static_cast<std::size_t>(std::ceil(3 * sigma));
    double sum = 0;
    for (std::size_t i = 0; i <= reach; ++i) {
      const double away = static_cast<double>(i) / sigma;
      weights_.push_back(static_cast<float>(std::exp(-away * away / 2)));
      sum += static_cast<double>(weights_.back()) * (i == 0 ? 1 : 2);
    }
    for (float& weight : weights_) weight /= static_cast<float>(sum);
  }

  void smooth(float* line, std::size_t count, std::size_t apart) {
    const std::size_t reach = weights_.size() - 1;
    padded_.assign(count + 2 * reach, 0);
    for (std::size_t i = 0; i < padded_.size(); ++i) {
      const std::size_t from = std::min(count - 1, i > reach ? i - reach : 0);
      padded_[i] = line[from * apart];
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float* const middle = &padded_[i + reach];
      float sum = weights_[0] * *middle;
      for (std::size_t k = 1; k <= reach; ++k) {
        const auto out = static_cast<std::ptrdiff_t>(k);
        sum += weights_[k] * (middle[-out] + middle[out]);
      }
      line[i * apart] = sum;
    }
  }

 private:
  std::vector<float> weights_;
  std::vector<float> padded_;
};

// `sigma_x`, `sigma_y`: in pixels.
std::vector<std::uint16_t> smoothed(const LevelPicture& picture, double sigma_x, double sigma_y) {
  constexpr double least = 0.1;  // pixels; less changes nothing
  std::vector<float> levels(picture.levels.begin(), picture.levels.end());
  if (sigma_x > least) {
    LineSmoother along(sigma_x);
    for (std::size_t y = 0; y < picture.rows; ++y) along.smooth(&levels[y * picture.columns], picture.columns, 1);
  }
  if (sigma_y > least) {
    LineSmoother across(sigma_y);
    for (std::size_t x = 0; x < picture.columns; ++x) across.smooth(&levels[x], picture.rows, picture.columns);
  }
  std::vector<std::uint16_t> rounded;
  rounded.reserve(levels.size());
  for (const float level : levels)
    rounded.push_back(static_cast<std::uint16_t>(std::clamp(level + 0.5F, 0.0F, 65535.0F)));
  return rounded;
}

}  // namespace

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
    const bool is_carved = bright >= shape.background;
    height_of[level] = is_carved ? grid_height(depth * (std::pow(bright, shape.gamma) - 1)) : 0.0F;
  }
  HeightGrid grid{
      .columns = picture.columns, .rows = picture.rows, .pitch_x = sides.x / across, .pitch_y = sides.y / up};
  constexpr double widest = 500;  // pixels; beyond, a picture is one level
  const auto sigma = [&](Mm pitch) { return std::min(widest, shape.smooth / pitch); };
  const bool is_smoothed = shape.smooth.value() > 0;
  const std::vector<std::uint16_t> smooth =
      is_smoothed ? smoothed(picture, sigma(grid.pitch_x), sigma(grid.pitch_y)) : std::vector<std::uint16_t>();
  const std::vector<std::uint16_t>& shown = is_smoothed ? smooth : picture.levels;
  grid.heights.resize(picture.levels.size());
  for (std::size_t y = 0; y < grid.rows; ++y) {
    const std::uint16_t* const from = &shown[(grid.rows - 1 - y) * grid.columns];
    float* const to = &grid.heights[y * grid.columns];
    for (std::size_t x = 0; x < grid.columns; ++x) to[x] = height_of[from[shape.mirror ? grid.columns - 1 - x : x]];
  }
  return completed(std::move(grid), shape, name, diagnostics);
}

namespace {

struct BodyBounds {
  SurfacePoint low;
  SurfacePoint high;
};

BodyBounds bounds_of(const std::vector<SurfaceTriangle>& faces) {
  BodyBounds bounds{.low = faces.front().front(), .high = faces.front().front()};
  for (const SurfaceTriangle& face : faces) {
    for (const SurfacePoint& corner : face) {
      bounds.low = {std::min(bounds.low.x, corner.x), std::min(bounds.low.y, corner.y),
                    std::min(bounds.low.z, corner.z)};
      bounds.high = {std::max(bounds.high.x, corner.x), std::max(bounds.high.y, corner.y),
                     std::max(bounds.high.z, corner.z)};
    }
  }
  return bounds;
}

// Fine enough for the cutters and for walls, and no finer than anybody could cut.
Mm body_pitch(const ReliefShape& shape, const Sides& sides) {
  if (shape.pitch) return *shape.pitch;
  constexpr double walls = 1400;  // nodes of the longest side
  const Mm coarse = std::max(shape.finest_pitch, std::max(sides.x, sides.y) / walls);
  const Mm wished = std::min(coarse, shape.wished_pitch.value_or(coarse));
  return std::max(wished, Mm(std::sqrt(sides.x.value() * sides.y.value() / static_cast<double>(most_fine_nodes))));
}

// What gamma makes of a height between -depth and 0.
class GammaCurve {
 public:
  GammaCurve(Mm depth, double gamma) : depth_(depth.value()), gamma_(gamma) {}

  double at(double z) const {
    if (gamma_ == 1 || depth_ <= 0) return z;
    return depth_ * (std::pow(std::clamp(z / depth_ + 1, 0.0, 1.0), gamma_) - 1);
  }
  // How far the curve rises above its chord. A gamma above 1 sags below it.
  double rise(double low, double high) const {
    if (gamma_ >= 1 || depth_ <= 0 || !(high > low)) return 0;
    const double slope = (at(high) - at(low)) / (high - low);
    const double farthest = depth_ * (std::pow(slope / gamma_, 1 / (gamma_ - 1)) - 1);  // where the tangent is parallel
    const double z = std::clamp(farthest, low, high);
    return std::max(0.0, at(z) - at(low) - slope * (z - low));
  }

 private:
  double depth_;
  double gamma_;
};

// Bends all heights; the patches stay above what is bent between their corners.
void bend(HeightGrid& grid, const GammaCurve& curve) {
  const std::vector<float> linear = grid.heights;
  for (float& height : grid.heights) height = static_cast<float>(curve.at(static_cast<double>(height)));
  const std::size_t columns = grid.columns;
  for (std::size_t cell = 0; cell + columns + 1 < linear.size(); ++cell) {
    if (cell % columns == columns - 1) continue;
    const std::size_t corners[] = {cell, cell + 1, cell + columns, cell + columns + 1};
    float low = 0;
    float high = -std::numeric_limits<float>::infinity();
    for (const std::size_t corner : corners) {
      low = std::min(low, linear[corner]);
      high = std::max(high, linear[corner]);
    }
    const double rise = curve.rise(static_cast<double>(low), static_cast<double>(high));
    if (rise <= 0) continue;
    const double top = curve.at(static_cast<double>(high));
    const bool is_small = rise < std::min(grid.pitch_x, grid.pitch_y).value() / 4;
    for (const std::size_t corner : corners) {
      const double raised = is_small ? curve.at(static_cast<double>(linear[corner])) + rise : top;
      grid.heights[corner] = std::max(grid.heights[corner], static_cast<float>(raised));
    }
  }
}

// The faces in the units of the grid: columns, rows, and mm below the highest point.
void put_on_grid(std::vector<SurfaceTriangle>& faces, const BodyBounds& bounds, const HeightGrid& grid, Mm depth,
                 bool mirror) {
  const double columns = static_cast<double>(grid.columns - 1);
  const double across = columns / (bounds.high.x - bounds.low.x);
  const double up = static_cast<double>(grid.rows - 1) / (bounds.high.y - bounds.low.y);
  const double high = bounds.high.z - bounds.low.z;
  const double scale = high > 0 ? depth.value() / high : 0;
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& corner : face) {
      corner.x = std::clamp((corner.x - bounds.low.x) * across, 0.0, columns);
      if (mirror) corner.x = columns - corner.x;
      corner.y = std::clamp((corner.y - bounds.low.y) * up, 0.0, static_cast<double>(grid.rows - 1));
      corner.z = (corner.z - bounds.high.z) * scale;
    }
  }
}

// Upside down, what is highest is the lowest point of the top near a place.
void look_upside_down(BodyCover& cover, const Surface& body, double depth) {
  const auto inverted = [&body, depth](double x, double y) {
    const double top = body.top(x, y);
    return top == Surface::nothing ? 0.0 : -depth - top;
  };
  constexpr double beside = 1e-6;
  cover.at_node = [inverted](double x, double y) {
    return std::max(std::max(inverted(x - beside, y), inverted(x + beside, y)),
                    std::max(inverted(x, y - beside), inverted(x, y + beside)));
  };
  cover.at_edge = [inverted](const SurfacePoint& point, double x, double y) {
    return std::max(inverted(point.x + x * beside, point.y + y * beside),
                    inverted(point.x - x * beside, point.y - y * beside));
  };
}

}  // namespace

HeightGrid relief_of(ReliefBody body, const ReliefShape& shape, const std::string& name, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string message, std::string expected) {
    diagnostics.add(of_file("relief.bad-body", name, std::move(message), std::move(expected)));
    return HeightGrid{};
  };
  const BodyBounds bounds = body.faces.empty() ? BodyBounds{} : bounds_of(body.faces);
  const double across = bounds.high.x - bounds.low.x;
  const double up = bounds.high.y - bounds.low.y;
  const double high = bounds.high.z - bounds.low.z;
  if (!(across > 1e-6 && up > 1e-6))
    return refuse("the model has no area when seen from above", "a model with faces that are visible from above");
  const Sides sides = sides_of(shape, across, up, Mm(across));
  const Mm depth = shape.depth.value_or(Mm(high * (sides.x.value() / across)));
  if (depth > deepest_relief && !shape.lowest) {
    return refuse(fmt::format("the model is {:.6g} mm high", depth.value()),
                  "at most 250 mm; check the unit, --depth and --lowest-z");
  }
  const Mm pitch = body_pitch(shape, sides);
  const double columns = std::floor(sides.x / pitch + 0.5) + 1;
  const double rows = std::floor(sides.y / pitch + 0.5) + 1;
  if (columns * rows > static_cast<double>(most_nodes)) {
    return refuse(fmt::format("{:.0f} by {:.0f} samples are too many", columns, rows), "a greater --pitch");
  }
  HeightGrid grid{.columns = static_cast<std::size_t>(std::max(2.0, columns)),
                  .rows = static_cast<std::size_t>(std::max(2.0, rows))};
  grid.pitch_x = sides.x / static_cast<double>(grid.columns - 1);
  grid.pitch_y = sides.y / static_cast<double>(grid.rows - 1);
  put_on_grid(body.faces, bounds, grid, depth, shape.mirror);
  BodyCover cover{.columns = grid.columns,
                  .rows = grid.rows,
                  .pitch = std::max(grid.pitch_x, grid.pitch_y).value(),
                  .floor = shape.invert ? 0.0F : static_cast<float>(-depth.value()),
                  .threads = shape.threads};
  if (body.height) {
    const double columns_all = static_cast<double>(grid.columns - 1);
    cover.has_straight_edges_only = true;
    cover.at_node = [&, columns_all, scale = high > 0 ? depth.value() / high : 0](double x, double y) {
      const double along = (shape.mirror ? columns_all - x : x) / columns_all;
      const double top =
          body.height(bounds.low.x + across * along, bounds.low.y + up * y / static_cast<double>(grid.rows - 1));
      return (top - bounds.high.z) * scale;
    };
  }
  Surface from_above;
  if (shape.invert) {
    if (body.height) {
      cover.at_node = [top = cover.at_node, depth](double x, double y) { return -depth.value() - top(x, y); };
      cover.at_edge = [depth](const SurfacePoint& point, double, double) { return -depth.value() - point.z; };
    } else {
      from_above = Surface(body.faces);
      look_upside_down(cover, from_above, depth.value());
    }
  }
  grid.heights = cover_body(body.faces, cover);
  body = {};
  bend(grid, GammaCurve(depth, shape.gamma));
  const auto lowest = static_cast<float>(-std::min(depth, shape.lowest.value_or(depth)).value());
  for (float& height : grid.heights) height = grid_height(Mm(static_cast<double>(std::clamp(height, lowest, 0.0F))));
  ReliefShape sampled = shape;
  sampled.pitch.reset();
  sampled.wished_pitch.reset();
  return completed(std::move(grid), sampled, name, diagnostics);
}

}  // namespace passo
