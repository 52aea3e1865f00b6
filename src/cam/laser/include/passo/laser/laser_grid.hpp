// burn_grid: a test grid, from which the power and the feed for a material are chosen.
//
// Each cell is a square that is filled with lines, or its outline. The power grows from left to right, the feed from
// top to bottom, both in equal steps; so the darkest cell is at the upper right. Cells with less energy come first.
// Labels in single-line letters give the power of each column in percent and the feed of each row in mm/min. The lower
// left corner of the lower left cell is X0 Y0.
#pragma once

#include <cstddef>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/laser/laser_program.hpp"

namespace passo {

struct LaserGrid {
  std::size_t columns = 5;
  std::size_t rows = 5;
  double least_percent = 20;  // of the first column
  double most_percent = 100;
  Nanometres least_feed{500'000'000};  // of the highest row, nm/min
  Nanometres most_feed{3'000'000'000};
  Nanometres size{8'000'000};  // of a cell
  Nanometres gap{3'000'000};
  Nanometres line{100'000};  // distance of the lines
  bool is_filled = true;     // otherwise only the outlines
  std::uint32_t passes = 1;
  BeamSetting label = {};
};

void burn_grid(LaserProgram& program, const LaserGrid& grid, Diagnostics& diagnostics);

}  // namespace passo
