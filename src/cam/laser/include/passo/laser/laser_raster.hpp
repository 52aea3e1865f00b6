// burn_raster: burns a picture line by line. cells_of() computes the power of each cell from the picture.
//
// The picture is divided into square cells, as large as the distance of the lines; its width is rounded to whole cells.
// The brightness of a cell is the mean brightness of the part of the picture that it covers. Its darkness is 1 less the
// brightness, to the power of gamma. From it follows the S word, which is exact for each cell:
//
// - grey: from `least_percent` at a darkness just above 0, in proportion to `most_percent` at 1; white stays unburned;
// - dither, ordered: full power or none, by the error diffusion of Floyd and Steinberg, or by Bayer's 8 x 8 matrix;
// - threshold: full power where the brightness is below the threshold.
//
// The head crosses each cell at the full feed: before the first and after the last burned cell of a line it runs on by
// the overscan, with the beam off. Neighbouring cells with equal S words are one move. Lines without a burned cell are
// left out, and long gaps are crossed by rapids.
//
// Sources: R. W. Floyd, L. Steinberg, An adaptive algorithm for spatial greyscale (1976); B. E. Bayer, An optimum
// method for two-level rendition of continuous-tone pictures (1973).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/carve/level_picture.hpp"
#include "passo/laser/laser_program.hpp"

namespace passo {

enum class ToneMode : std::uint8_t { grey, dither, ordered, threshold };

struct ToneOptions {
  ToneMode mode = ToneMode::grey;
  double threshold = 50;  // percent of white
  double gamma = 1;
  bool invert = false;
  bool mirror_x = false;  // left and right change places
  bool mirror_y = false;  // top and bottom change places
  double least_percent = 0;
  double most_percent = 80;
  std::uint32_t most_s = 1000;
};

// The S words of the cells, rows from the bottom to the top.
struct BeamCells {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<std::uint32_t> s = {};
};

inline constexpr std::size_t most_beam_cells = 16'000'000;

// The size of a picture in cells, for its width. A row and a column at least.
struct CellCount {
  double columns = 0;
  double rows = 0;
};
CellCount count_cells(const LevelPicture& picture, Mm width, Mm line);

// `columns` and `rows`: at most most_beam_cells together.
BeamCells cells_of(const LevelPicture& picture, std::size_t columns, std::size_t rows, const ToneOptions& options);

// How far the head needs to reach the feed, from rest: v²/2a.
Nanometres overscan_for(Nanometres feed, MmPerSecond2 acceleration);

struct RasterMoves {
  DrawnPoint origin = {};  // lower left corner of the cells
  Nanometres line{100'000};
  bool is_along_y = false;  // the lines run along Y
  bool is_one_way = false;
  Nanometres feed{1'000'000'000};
  Nanometres overscan{};
};

void burn_raster(LaserProgram& program, const BeamCells& cells, const RasterMoves& moves);

}  // namespace passo
