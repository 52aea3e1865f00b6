// Pictures of a toolpath and of the stock after cutting, as pixels or as the bytes of a PNG file.
//
// Threads: several threads may call any function at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/library/check.hpp"

namespace passo::v1 {

// Pixels from the upper left corner, row by row: red, green, blue, 8 bits each.
struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  std::vector<std::uint8_t> rgb = {};
};

enum class PathTint : std::uint8_t { speed, depth, tool, torque };

struct PictureOptions {
  std::string title = {};
  PathTint tint = PathTint::speed;  // what the colour of the feed moves shows
  bool rapids = true;
  int width = 1600;  // pixels, 200 to 8000
  int height = 900;
};

// Draws the toolpath of a program. Errors: those of check(), and "picture.*".
PASSO_EXPORTED Outcome<Picture> draw_toolpath(const Program& program, const Machine& machine,
                                              const PictureOptions& options = {}, const ReadOptions& read = {});

// The shape of a milling tool.
struct MillingTool {
  enum class Kind : std::uint8_t { flat, ball, vee };
  Kind kind = Kind::flat;
  double diameter_mm = 3;          // 0.01 to 500
  double included_angle_deg = 60;  // only for a vee: 1 to 179
  double tip_diameter_mm = 0;      // only for a vee: its flat tip
};

struct StockOptions {
  ReadOptions read = {};
  // The tool for each T number that is not in tools_file.
  std::optional<MillingTool> tool = {};
  std::string tools_file = {};  // TOML: docs/manual/simulate.md; empty: none
  // The range of the block in program coordinates; empty: as large as the feed moves require.
  std::optional<AxisRange> x_mm = {};
  std::optional<AxisRange> y_mm = {};
  std::optional<AxisRange> z_mm = {};
  double cell_mm = 0;    // the size of a cell; 0: a size that gives about a million cells
  unsigned threads = 1;  // 1 to 64
};

// A piece of stock after cutting, as heights over a grid.
struct Stock {
  double cell_mm = 0;
  double left_mm = 0;   // X of the corner of the first cell
  double front_mm = 0;  // Y
  double top_mm = 0;    // Z before cutting
  double bottom_mm = 0;
  std::size_t columns = 0;               // along X
  std::size_t rows = 0;                  // along Y
  std::vector<float> below_top_mm = {};  // row by row: 0 is the top; cut cells are negative
  double removed_mm3 = 0;
};

// Cuts a block with the program. Problems such as a rapid move through the stock are warnings and errors ("simulate.*")
// of the outcome. The outcome has a stock even then; it has none if the program or the options are wrong.
PASSO_EXPORTED Outcome<Stock> cut_stock(const Program& program, const StockOptions& options = {});
PASSO_EXPORTED Outcome<Picture> draw_stock(const Stock& stock, const PictureOptions& options = {});

// Encodes pixels as a PNG file.
PASSO_EXPORTED std::string png_of(const Picture& picture);

}  // namespace passo::v1
