#include "path_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace passo {
namespace {

constexpr std::array<std::array<int, 3>, 6> palette = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};

constexpr std::size_t full_load = 100;

}  // namespace

PathColours::PathColours(const PathRecorder& path, PathColour by)
    : by_(by),
      speeds_(path.fastest_feed()),
      top_(path.feed_extents().high[Axis::z] - path.base()[Axis::z]),
      height_(path.feed_extents().high[Axis::z] - path.feed_extents().low[Axis::z]) {}

std::size_t PathColours::classes() const {
  return by_ == PathColour::tool ? palette.size() : SpeedColours::classes;
}

std::size_t PathColours::class_of(const PathRecorder::Vertex& vertex, double z) const {
  if (by_ == PathColour::tool) return vertex.tool % palette.size();
  if (by_ == PathColour::margin) {
    return std::min(SpeedColours::classes - 1, std::size_t{vertex.load} * SpeedColours::classes / full_load);
  }
  if (by_ == PathColour::speed) return speeds_.class_of(double{vertex.speed});
  const double share = height_ > 0 ? std::clamp((top_ - z) / height_, 0.0, 1.0) : 1;
  return std::min(SpeedColours::classes - 1, static_cast<std::size_t>(share * SpeedColours::classes));
}

Colour PathColours::of_class(std::size_t index) const {
  return by_ == PathColour::tool ? of_tool(index) : SpeedColours::of_class(index);
}

int PathColours::parts_between(double from_z, double to_z) const {
  if (by_ != PathColour::depth || !(height_ > 0)) return 1;
  const double share = std::min(1.0, std::abs(to_z - from_z) / height_);
  return std::max(1, static_cast<int>(std::ceil(share * SpeedColours::classes)));
}

Colour PathColours::of_tool(std::size_t index) {
  const auto& [red, green, blue] = palette[index % palette.size()];
  return {red / 255.0, green / 255.0, blue / 255.0};
}

}  // namespace passo
