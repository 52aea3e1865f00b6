// DrawnPicture: the surface that a grey picture means, for DrawnSolid. It is read by libpng alone. DrawnRelief: what a
// ball leaves of it.
//
// The centres of the outermost pixels lie on the edges of a box. White is Z 0, black the depth; between four centres
// the surface is bilinear. Lengths are mm.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kit/drawn_solid.hpp"
#include <png.h>

namespace passo::test {

class DrawnPicture {
 public:
  DrawnPicture(const std::string& file, FlatPoint low, FlatPoint high, double depth)
      : low_(low), high_(high), depth_(depth) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, file.c_str()) == 0) throw std::runtime_error(image.message);
    // Grey levels as they stand in the file.
    image.format = PNG_FORMAT_GRAY;
    levels_.resize(PNG_IMAGE_SIZE(image));
    if (png_image_finish_read(&image, nullptr, levels_.data(), 0, nullptr) == 0)
      throw std::runtime_error(image.message);
    across_ = image.width;
    up_ = image.height;
  }

  double operator()(FlatPoint at) const {
    const Place x(at.x, low_.x, high_.x, across_);
    const Place y(at.y, low_.y, high_.y, up_);
    const auto row = [&](std::size_t j) { return (1 - x.share) * level(x.cell, j) + x.share * level(x.cell + 1, j); };
    return depth_ * (1 - ((1 - y.share) * row(y.cell) + y.share * row(y.cell + 1)) / 255);
  }

 private:
  // Where a position is between the centres of two pixels.
  struct Place {
    Place(double at, double low, double high, std::size_t count) {
      const double place = (at - low) / (high - low) * static_cast<double>(count - 1);
      cell = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 2)));
      share = place - static_cast<double>(cell);
    }
    std::size_t cell;
    double share;
  };
  double level(std::size_t i, std::size_t j) const { return levels_[(up_ - 1 - j) * across_ + i]; }

  FlatPoint low_;
  FlatPoint high_;
  double depth_;
  std::vector<std::uint8_t> levels_;  // from the top
  std::size_t across_ = 0;
  std::size_t up_ = 0;
};

// The ball goes down until it touches the surface, at each node of a fine grid. What remains below it is the closing of
// the surface by the ball. Rows leave scallops, which are higher on slopes, and any amount within 2 mm of a wall.
class DrawnRelief {
 public:
  DrawnRelief(DrawnPicture picture, FlatPoint low, FlatPoint high, double radius, double scallop)
      : picture_(std::move(picture)), low_(low), high_(high), radius_(radius), scallop_(scallop) {
    across_ = count(high.x - low.x);
    up_ = count(high.y - low.y);
    std::vector<double> surface(across_ * up_);
    for (std::size_t j = 0; j < up_; ++j) {
      for (std::size_t i = 0; i < across_; ++i) surface[j * across_ + i] = picture_({x_of(i), y_of(j)});
    }
    const std::vector<double> tips = around(surface, -1);
    left_ = around(tips, 1);
  }

  double surface(FlatPoint at) const { return picture_(at); }
  double left(FlatPoint at) const {
    const std::size_t i = cell((at.x - low_.x) / pitch, across_);
    const std::size_t j = cell((at.y - low_.y) / pitch, up_);
    double steep = 0;
    for (std::size_t v = near(j); v < std::min(j + reach + 1, up_ - 1); ++v) {
      for (std::size_t u = near(i); u < std::min(i + reach + 1, across_ - 1); ++u) {
        const auto [low, high] = of_cell(u, v);
        steep = std::max(steep, (high - low) / pitch);
      }
    }
    if (steep > wall) return 0;
    const auto [low, high] = of_cell(i, j);
    const double slope = (high - low) / pitch;
    return high + scallop_ * std::pow(1 + slope * slope, 1.5);
  }

 private:
  static constexpr double pitch = 0.25;
  static constexpr std::size_t reach = 8;  // cells
  static constexpr double wall = 1;        // slope

  static std::size_t cell(double place, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 2)));
  }
  static std::size_t near(std::size_t index) { return index - std::min(index, reach); }
  std::pair<double, double> of_cell(std::size_t i, std::size_t j) const {
    const std::size_t at = j * across_ + i;
    return std::minmax({left_[at], left_[at + 1], left_[at + across_], left_[at + across_ + 1]});
  }
  static std::size_t count(double length) { return static_cast<std::size_t>(std::lround(length / pitch)) + 1; }
  double x_of(std::size_t i) const { return low_.x + static_cast<double>(i) * pitch; }
  double y_of(std::size_t j) const { return low_.y + static_cast<double>(j) * pitch; }
  // -1: the highest of the heights below the ball, lowered to its tip. 1: the lowest of the balls above.
  std::vector<double> around(const std::vector<double>& heights, int sign) const {
    const int reach = static_cast<int>(radius_ / pitch);
    const auto width = static_cast<int>(across_);
    const auto height = static_cast<int>(up_);
    std::vector<double> result(heights.size(), std::numeric_limits<double>::infinity());
    for (int dj = -reach; dj <= reach; ++dj) {
      for (int di = -reach; di <= reach; ++di) {
        const double square = radius_ * radius_ - pitch * pitch * (di * di + dj * dj);
        if (square < 0) continue;
        const double rise = radius_ - std::sqrt(square);
        for (int j = std::max(0, -dj); j < height - std::max(0, dj); ++j) {
          for (int i = std::max(0, -di); i < width - std::max(0, di); ++i) {
            double& one = result[static_cast<std::size_t>(j * width + i)];
            const double other = heights[static_cast<std::size_t>((j + dj) * width + i + di)];
            one = std::min(one, sign * other + rise);
          }
        }
      }
    }
    if (sign < 0) {
      for (double& one : result) one = -one;
    }
    return result;
  }

  DrawnPicture picture_;
  FlatPoint low_;
  FlatPoint high_;
  double radius_;
  double scallop_;
  std::size_t across_ = 0;
  std::size_t up_ = 0;
  std::vector<double> left_;
};

}  // namespace passo::test
