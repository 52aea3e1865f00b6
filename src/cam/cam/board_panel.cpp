#include "passo/cam/board_panel.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {
namespace {

DrawnPoint moved_by(DrawnPoint at, DrawnPoint offset) {
  return {at.x + offset.x, at.y + offset.y};
}

bool is_in(const DrawnBox& box, DrawnPoint at) {
  return box.least.x <= at.x && at.x <= box.most.x && box.least.y <= at.y && at.y <= box.most.y;
}

}  // namespace

std::vector<DrawnPoint> offsets_of(const PanelGrid& grid, const DrawnBox& board) {
  const Nanometres right = board.most.x - board.least.x + grid.gap;
  const Nanometres up = board.most.y - board.least.y + grid.gap;
  std::vector<DrawnPoint> offsets;
  for (std::int64_t row = 0; row < grid.rows; ++row) {
    for (std::int64_t column = 0; column < grid.columns; ++column)
      offsets.push_back({{column * right.count}, {row * up.count}});
  }
  return offsets;
}

Region repeated(const Region& region, const std::vector<DrawnPoint>& offsets) {
  Region all;
  all.rings.reserve(region.rings.size() * offsets.size());
  for (const DrawnPoint& offset : offsets) {
    for (const DrawnRing& ring : region.rings) {
      all.rings.push_back(ring);
      for (DrawnPoint& point : all.rings.back()) point = moved_by(point, offset);
    }
  }
  return all;
}

Drawing repeated(const Drawing& drawing, const std::vector<DrawnPoint>& offsets) {
  Drawing all{.file = drawing.file, .layers = drawing.layers, .holes = {}, .paths = {}, .notes = drawing.notes};
  for (const DrawnPoint& offset : offsets) {
    for (DrawnHole hole : drawing.holes) {
      hole.at = moved_by(hole.at, offset);
      all.holes.push_back(hole);
    }
    for (const DrawnPath& path : drawing.paths) {
      all.paths.push_back(path);
      for (PathPoint& point : all.paths.back().points) point.at = moved_by(point.at, offset);
    }
  }
  return all;
}

BoardLayer repeated(const BoardLayer& layer, const std::vector<DrawnPoint>& offsets) {
  BoardLayer all{
      .face = repeated(layer.face, offsets), .lines = repeated(layer.lines, offsets), .bare = {}, .nets = {}};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    for (NetPlace place : layer.nets) {
      place.at = moved_by(place.at, offsets[i]);
      if (!place.net.empty() && offsets.size() > 1) place.net += fmt::format(" of copy {}", i + 1);
      all.nets.push_back(std::move(place));
    }
  }
  return all;
}

void trim_to(const DrawnBox& box, BoardLayer& layer) {
  layer.face = common(layer.face, Region{{rectangle(box)}});
  std::erase_if(layer.nets, [&](const NetPlace& place) { return !is_in(box, place.at); });
  std::erase_if(layer.lines.paths, [&](const DrawnPath& path) {
    return std::ranges::none_of(path.points, [&](const PathPoint& point) { return is_in(box, point.at); });
  });
}

std::size_t trim_to(const DrawnBox& box, Drawing& drills) {
  const std::size_t before = drills.holes.size() + drills.paths.size();
  std::erase_if(drills.holes, [&](const DrawnHole& hole) { return !is_in(box, hole.at); });
  std::erase_if(drills.paths, [&](const DrawnPath& path) {
    return std::ranges::any_of(path.points, [&](const PathPoint& point) { return !is_in(box, point.at); });
  });
  return before - drills.holes.size() - drills.paths.size();
}

}  // namespace passo
