// NodeMask: a flag for each node of a map. Private to carve/.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "level_lines.hpp"

namespace passo {

class NodeMask {
 public:
  explicit NodeMask(const TipMap& map) : map_(map), marks_(map.columns * map.rows, 0) {}

  // Nodes by their positions in the map, including its margins.
  char& mark(std::size_t column, std::size_t row) { return marks_[row * map_.columns + column]; }
  bool at(std::ptrdiff_t column, std::ptrdiff_t row) const {
    return marks_[static_cast<std::size_t>(row + map_.margin_y) * map_.columns +
                  static_cast<std::size_t>(column + map_.margin_x)] != 0;
  }
  bool near(const FlatPlace& place, const TipSurface& surface) const {
    const auto node = [](double at, double pitch, std::ptrdiff_t margin, std::size_t count) {
      const auto nearest = static_cast<std::ptrdiff_t>(std::lround(at / pitch));
      return std::clamp<std::ptrdiff_t>(nearest, -margin, static_cast<std::ptrdiff_t>(count) - 1 - margin);
    };
    return at(node(place.x, surface.pitch_x(), map_.margin_x, map_.columns),
              node(place.y, surface.pitch_y(), map_.margin_y, map_.rows));
  }
  void invert() {
    for (char& mark : marks_) mark = mark == 0 ? 1 : 0;
  }
  // So many nodes more each way.
  void widen(std::ptrdiff_t columns, std::ptrdiff_t rows) {
    for (std::size_t row = 0; row < map_.rows; ++row) widen_line(row * map_.columns, 1, map_.columns, columns);
    for (std::size_t column = 0; column < map_.columns; ++column) widen_line(column, map_.columns, map_.rows, rows);
  }

 private:
  void widen_line(std::size_t first, std::size_t apart, std::size_t count, std::ptrdiff_t nodes) {
    std::ptrdiff_t last = -nodes - 1;  // the last mark before
    std::vector<char>& line = line_;
    line.assign(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (marks_[first + i * apart] != 0) last = static_cast<std::ptrdiff_t>(i);
      if (static_cast<std::ptrdiff_t>(i) - last <= nodes) line[i] = 1;
    }
    last = static_cast<std::ptrdiff_t>(count) + nodes;
    for (std::size_t i = count; i-- > 0;) {
      if (marks_[first + i * apart] != 0) last = static_cast<std::ptrdiff_t>(i);
      if (last - static_cast<std::ptrdiff_t>(i) <= nodes) line[i] = 1;
    }
    for (std::size_t i = 0; i < count; ++i) marks_[first + i * apart] = line[i];
  }

  const TipMap& map_;
  std::vector<char> marks_;
  std::vector<char> line_;
};

}  // namespace passo
