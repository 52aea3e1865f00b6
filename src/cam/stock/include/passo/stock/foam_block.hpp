// FoamBlock: a block of foam cut by a hot wire; stores for each cell the distance of its centre from the melted
// material.
//
// The wire runs along Z, from the left tower at Z 0 to the right one. The block is represented by slices across Z, from
// its left face to its right one. A slice has equal cells in X and Y. Each cell stores its distance from the edge of
// the melted slots, so an edge between two cells is resolved much more finely than the cells.
//
// Lengths are mm. Memory: four bytes per cell.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/stock/height_field.hpp"

namespace passo {

class FoamBlock {
 public:
  static constexpr std::size_t most_cells = 100'000'000;  // maximum number of cells in all slices

  // The cells cover the faces starting at their lower left corner; the last column and row may extend over the edge.
  // `slices`: at least 2; the first and the last are the faces.
  static Result<FoamBlock, FieldRefusal> create(const StockBlock& block, Mm cell, std::size_t slices);
  // Returns the number of slices for a block in which the wire's positions on the two faces differ by at most `shift`
  // mm in X Y. Between two slices a slot then shifts by at most two cells plus half of its kerf, mm, so that the
  // material between the slices is determined, too.
  static std::size_t needed_slices(double shift, Mm cell, double kerf);
  // Returns a round cell size that gives a block at most about thirty million cells in the required number of slices.
  static Mm usual_cell(const StockBlock& block, double shift, double kerf);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  std::size_t slices() const { return slices_; }
  double cell() const { return cell_; }
  const StockBlock& block() const { return block_; }

  // The centre of a cell, and the position of a slice.
  double x_of(std::size_t column) const { return block_.low.x + (static_cast<double>(column) + 0.5) * cell_; }
  double y_of(std::size_t row) const { return block_.low.y + (static_cast<double>(row) + 0.5) * cell_; }
  double z_of(std::size_t slice) const {
    return block_.low.z +
           (block_.high.z - block_.low.z) * static_cast<double>(slice) / static_cast<double>(slices_ - 1);
  }
  // Returns the width that a slice represents, in units of half the slice distance: 1 for a face, otherwise 2.
  unsigned weight(std::size_t slice) const { return slice == 0 || slice + 1 == slices_ ? 1 : 2; }
  // Returns the volume of a cell with the weight 1, mm³.
  double volume_of_cell() const;

  // Greater distances are clipped to this.
  float farthest() const { return static_cast<float>(2 * cell_); }
  // Return the distances of a row. Positive: foam.
  float* clearance(std::size_t row, std::size_t slice) { return clearance_.data() + (slice * rows_ + row) * columns_; }
  const float* clearance(std::size_t row, std::size_t slice) const {
    return clearance_.data() + (slice * rows_ + row) * columns_;
  }

  // Returns the remaining foam, mm³. A cell at an edge counts in proportion to its remaining part.
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

// The connected pieces of foam. Cells that touch only at a corner are not connected.
struct FoamPieces {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  struct Piece {
    std::uint64_t cells = 0;  // number of cells, weighted by their slices
    bool at_side = false;     // touches the block's edge in X or Y
  };
  std::vector<Piece> pieces = {};      // the largest first
  std::vector<std::uint32_t> of = {};  // the piece of each cell: slice by slice, row by row; none: melted

  // Returns the volume of a piece, mm³.
  double volume(std::size_t piece, const FoamBlock& foam) const {
    return static_cast<double>(pieces[piece].cells) * foam.volume_of_cell();
  }
};
FoamPieces pieces_of(const FoamBlock& foam);

}  // namespace passo
