// NodeRun: a straight run of nodes with the tip height at each, and its approximation by few lines.
//
// The tip heights are the lowest gouge-free ones, at the nodes and on the straight lines between them. Therefore a line
// that is nowhere below them at the nodes it passes is gouge-free, too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "move_writer.hpp"

namespace passo {

// Maps nodes to positions in the program.
struct NodeLattice {
  double x0 = 0;  // mm, position of node (0, 0)
  double y0 = 0;
  double pitch_x = 0;
  double pitch_y = 0;
  bool turned = false;  // X and Y of the program are the rows and columns here

  CarvedPlace at(std::ptrdiff_t column, std::ptrdiff_t row, std::int64_t z) const {
    const std::ptrdiff_t i = turned ? row : column;
    const std::ptrdiff_t j = turned ? column : row;
    return {std::llround((x0 + static_cast<double>(i) * pitch_x) * carved_units),
            std::llround((y0 + static_cast<double>(j) * pitch_y) * carved_units), z};
  }
};

// Rounds a height upwards, with an allowance of 1/65536 mm for the rounding of the grid's heights.
inline std::int64_t carved_height(double z) {
  constexpr double slack = 0.25;
  return static_cast<std::int64_t>(std::ceil(z * carved_units - slack));
}

struct NodeRun {
  std::ptrdiff_t column = 0;  // column of the first node
  std::ptrdiff_t row = 0;
  int step_x = 1;  // step between nodes: -1, 0 or 1
  int step_y = 0;
  std::vector<float> heights = {};

  std::ptrdiff_t column_at(std::size_t i) const { return column + step_x * static_cast<std::ptrdiff_t>(i); }
  std::ptrdiff_t row_at(std::size_t i) const { return row + step_y * static_cast<std::ptrdiff_t>(i); }

  // Returns the same run in reverse order.
  NodeRun backwards() const {
    const std::size_t last = heights.size() - 1;
    NodeRun other{.column = column_at(last), .row = row_at(last), .step_x = -step_x, .step_y = -step_y};
    other.heights.assign(heights.rbegin(), heights.rend());
    return other;
  }
};

// Fits a straight line from the node `begin`, at the height `from`, that is nowhere below `heights` and at most
// `tolerance` above. The line is as long as possible, and ends as low as possible. Calls emit(index, height in carved
// units) for its end. Source: the cone of slopes of Williams, "An efficient algorithm for the piecewise linear
// approximation of planar curves", 1978.
template <class Emit>
void fit_line(const std::vector<float>& heights, std::size_t begin, double from, double tolerance, const Emit& emit) {
  double low = heights[begin + 1] - from;
  double high = low + tolerance;
  std::size_t end = begin + 1;
  for (std::size_t i = begin + 2; i < heights.size(); ++i) {
    const auto steps = static_cast<double>(i - begin);
    const double need = heights[i] - from;
    if (need > high * steps || need + tolerance < low * steps) break;
    // Usually at most one of the two bounds becomes tighter; otherwise no division is needed.
    if (need > low * steps) low = need / steps;
    if (need + tolerance < high * steps) high = (need + tolerance) / steps;
    end = i;
  }
  emit(end, carved_height(from + low * static_cast<double>(end - begin)));
}

// Covers `heights` with such lines; the first one begins at the first node, at the height `from`.
template <class Emit>
void fit_lines(const std::vector<float>& heights, double from, double tolerance, const Emit& emit) {
  for (std::size_t begin = 0; begin + 1 < heights.size();) {
    fit_line(heights, begin, from, tolerance, [&](std::size_t end, std::int64_t height) {
      emit(end, height);
      from = static_cast<double>(height) / carved_units;
      begin = end;
    });
  }
}

// Cuts along the run. The tool must be at the run's first node, at its height or above.
inline void cut_run(MoveWriter& writer, const NodeLattice& lattice, const NodeRun& run, double tolerance) {
  const double from = static_cast<double>(writer.place().z) / carved_units;
  fit_lines(run.heights, from, tolerance,
            [&](std::size_t i, std::int64_t z) { writer.cut_to(lattice.at(run.column_at(i), run.row_at(i), z)); });
}

}  // namespace passo
