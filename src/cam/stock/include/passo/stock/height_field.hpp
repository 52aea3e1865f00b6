// HeightField: the upper surface of a piece of stock, as a height for each cell of a uniform grid in X and Y.
//
// A height is that of the cell's centre, and never below the bottom. A height field cannot represent overhangs; since
// tools come from above, there are none.
//
// Lengths are millimetres. Memory: four bytes per cell. Heights are stored relative to the top, as floats: at a depth
// of 10 mm their resolution is a thousandth of a micrometre.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/geometry/vector3.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The corners of a block, in program coordinates.
struct StockBlock {
  Vector3 low;
  Vector3 high;
};

// The reason why a field cannot be created, as text for the user.
struct FieldRefusal {
  std::string message;
};

class HeightField {
 public:
  static constexpr std::size_t most_cells = 100'000'000;

  // The cells cover the block starting at its lower left corner; the last column and row may extend over its edge.
  static Result<HeightField, FieldRefusal> create(const StockBlock& block, Mm cell);
  // Returns a round cell size that gives a block about a million cells: 0.1 mm for 100 x 100 mm.
  static Mm usual_cell(const StockBlock& block);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double cell() const { return cell_; }
  const StockBlock& block() const { return block_; }
  double top() const { return block_.high.z; }
  double bottom() const { return block_.low.z; }

  // The centre of a cell.
  double x_of(std::size_t column) const { return block_.low.x + (static_cast<double>(column) + 0.5) * cell_; }
  double y_of(std::size_t row) const { return block_.low.y + (static_cast<double>(row) + 0.5) * cell_; }
  double height(std::size_t column, std::size_t row) const {
    return top() + static_cast<double>(below_top(row)[column]);
  }
  void set_height(std::size_t column, std::size_t row, double z);

  // Return the heights of a row relative to the top: 0 is the top; cut cells are negative.
  float* below_top(std::size_t row) { return heights_.data() + row * stride_; }
  const float* below_top(std::size_t row) const { return heights_.data() + row * stride_; }

  // Returns the volume between the surface and the bottom, mm³.
  double volume() const;

 private:
  HeightField(const StockBlock& block, double cell, std::size_t columns, std::size_t rows);

  StockBlock block_;
  double cell_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::size_t stride_ = 0;  // number of floats from one row to the next
  std::vector<float> heights_;
};

}  // namespace passo
