// WallHeights: the heights of a field between the centres of its cells, at the places where a wall stands.
//
// A height field knows the stock at the centres of its cells only. Where the heights of neighbouring centres jump by
// more than their distance, a wall stands somewhere between them. `at_walls_of()` finds these places in the stock after
// the cut; a StockCutter then finds the heights there, by the same moves, at points five times as dense.
//
// A lattice of every `step`-th centre divides the field into squares. Heights are stored in patches of 3 x 3 squares.
// Memory: a bit for each square, and at most six bytes for each cell of the field. If there are more walls, only the
// highest have heights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "passo/stock/height_field.hpp"

namespace passo {

class WallHeights {
 public:
  static constexpr std::size_t parts = 5;  // of a square's side

  struct Patch {
    std::size_t column = 0;  // the cell of its lower left corner
    std::size_t row = 0;
    HeightField heights;
  };

  // No walls.
  WallHeights() = default;
  // The walls of a field, whose heights are those of the uncut stock. `step`: at least 1.
  static WallHeights at_walls_of(const HeightField& field, std::size_t step);
  // The first place of the lattice along an axis with so many cells.
  static std::size_t first_place(std::size_t cells, std::size_t step);

  bool any() const { return !patches_.empty(); }
  std::vector<Patch>& patches() { return patches_; }
  // The distance between two points, and the size of a patch.
  Mm spacing() const { return spacing_; }
  Mm patch_size() const;

  // Whether a wall crosses the square. Squares beyond the lattice have none.
  bool crosses(std::size_t across, std::size_t up) const {
    return across < across_ && up < up_ && is_wall_[up * across_ + across];
  }
  // A point of a square that a wall crosses. `i`, `j`: 0 to `parts`, from the lower left corner.
  double height(std::size_t across, std::size_t up, std::size_t i, std::size_t j) const;

 private:
  std::size_t find_walls(const HeightField& field, std::size_t step, double height);
  void add_patches(const HeightField& field, std::size_t step);

  Mm spacing_{0};
  std::size_t across_ = 0;  // squares
  std::size_t up_ = 0;
  std::size_t patches_across_ = 0;
  std::vector<bool> is_wall_;
  std::vector<std::uint32_t> patch_at_;  // one more than the index of the patch; 0: none
  std::vector<Patch> patches_;
};

}  // namespace passo
