// FoamBlock: a block of foam that a hot wire cuts: for each cell how far its middle is from what the wire has melted.
//
// The wire goes along Z, from the left tower at Z 0 to the right one. The block is looked at in slices across it, from
// its left face to its right one. A slice has even cells in X and Y. Each cell has its distance from the edge of the
// melted slots: so the edge between two cells is known far more finely than the cells are.
//
// Lengths are mm. Memory: four bytes a cell.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/stock/height_field.hpp"

namespace passo {

class FoamBlock {
 public:
  static constexpr std::size_t most_cells = 100'000'000;  // of all slices

  // The cells cover the faces from their lower left corner on; the last column and row may reach over the edge.
  // `slices`: 2 or more; the first and the last are the faces.
  static Result<FoamBlock, FieldRefusal> create(const StockBlock& block, Mm cell, std::size_t slices);
  // How many slices a block needs whose slots lie at most `shift` mm apart in X Y on its two faces. Between two slices
  // a slot then goes no farther than two cells and half of its kerf, mm: so what is between the slices is known too.
  static std::size_t needed_slices(double shift, Mm cell, double kerf);
  // A round cell size that gives a block some thirty million cells at most, with as many slices as it needs.
  static Mm usual_cell(const StockBlock& block, double shift, double kerf);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  std::size_t slices() const { return slices_; }
  double cell() const { return cell_; }
  const StockBlock& block() const { return block_; }

  // The middle of a cell, and the place of a slice.
  double x_of(std::size_t column) const { return block_.low.x + (static_cast<double>(column) + 0.5) * cell_; }
  double y_of(std::size_t row) const { return block_.low.y + (static_cast<double>(row) + 0.5) * cell_; }
  double z_of(std::size_t slice) const {
    return block_.low.z +
           (block_.high.z - block_.low.z) * static_cast<double>(slice) / static_cast<double>(slices_ - 1);
  }
  // A slice stands for so much of the block's width, in half distances of two slices: 1 for a face, otherwise 2.
  unsigned weight(std::size_t slice) const { return slice == 0 || slice + 1 == slices_ ? 1 : 2; }
  // The volume of a cell with the weight 1, mm³.
  double volume_of_cell() const;

  // Distances greater than this count as this.
  float farthest() const { return static_cast<float>(2 * cell_); }
  // The distances of a row. Above 0 there is foam.
  float* clearance(std::size_t row, std::size_t slice) { return clearance_.data() + (slice * rows_ + row) * columns_; }
  const float* clearance(std::size_t row, std::size_t slice) const {
    return clearance_.data() + (slice * rows_ + row) * columns_;
  }

  // The foam that is left, mm³. A cell at an edge counts by the part of it that the edge leaves.
  double volume() const;

 private:
  FoamBlock(const StockBlock& block, double cell, std::size_t columns, std::size_t rows, std::size_t slices);

  StockBlock block_;
  double cell_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::size_t slices_ = 0;
  std::vector<float> clearance_;
};

// The foam that hangs together. Of two cells that touch at a corner alone neither holds the other.
struct FoamPieces {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  struct Piece {
    std::uint64_t cells = 0;  // times their weight
    bool at_side = false;     // reaches the block's edge in X or Y
  };
  std::vector<Piece> pieces = {};      // the largest first
  std::vector<std::uint32_t> of = {};  // the piece of each cell: slice by slice, row by row; none: melted

  // mm³.
  double volume(std::size_t piece, const FoamBlock& foam) const {
    return static_cast<double>(pieces[piece].cells) * foam.volume_of_cell();
  }
};
FoamPieces pieces_of(const FoamBlock& foam);

}  // namespace passo
