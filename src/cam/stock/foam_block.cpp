#include "passo/stock/foam_block.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace passo {
namespace {

// Sets of cells that hang together: each cell leads to another one of its set, and in the end to the first.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t first_of(std::uint32_t cell) {
    while (parent_[cell] != cell) {
      parent_[cell] = parent_[parent_[cell]];
      cell = parent_[cell];
    }
    return cell;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({first_of(a), first_of(b)});
    parent_[high] = low;
  }
  // For each cell the number of its set. Sets are counted in the order of their first cells.
  std::vector<std::uint32_t> take_numbers(const float* cells, std::uint32_t none) {
    constexpr std::uint32_t is_number = 0x80000000;  // in the place of a cell
    std::uint32_t sets = 0;
    for (std::uint32_t cell = 0; cell < parent_.size(); ++cell) {
      // A parent comes before its cells: it has its number.
      if (parent_[cell] != cell) {
        parent_[cell] = parent_[parent_[cell]];
      } else if (cells[cell] > 0) {
        parent_[cell] = is_number | sets++;
      }
    }
    for (std::uint32_t& number : parent_) number = (number & is_number) != 0 ? number & ~is_number : none;
    return std::move(parent_);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

FoamBlock::FoamBlock(const StockBlock& block, double cell, std::size_t columns, std::size_t rows, std::size_t slices)
    : block_(block), cell_(cell), columns_(columns), rows_(rows), slices_(slices) {
  clearance_.assign(columns_ * rows_ * slices_, farthest());
}

Result<FoamBlock, FieldRefusal> FoamBlock::create(const StockBlock& block, Mm cell, std::size_t slices) {
  const Vector3 size = block.high - block.low;
  if (!(size.x > 0 && size.y > 0 && size.z > 0) || !is_finite(size)) return Failure{FieldRefusal{"the block is empty"}};
  if (!(cell > Mm(0))) return Failure{FieldRefusal{"a cell must be larger than 0 mm"}};
  // A block that is a whole number of cells wide has no column more for the sake of rounding.
  constexpr double rounding = 1e-9;
  const double columns = std::max(1.0, std::ceil(size.x / cell.value() - rounding));
  const double rows = std::max(1.0, std::ceil(size.y / cell.value() - rounding));
  const double cells = columns * rows * static_cast<double>(slices);
  if (!(cells <= static_cast<double>(most_cells))) {
    return Failure{FieldRefusal{fmt::format(
        "{} slices of {:g} x {:g} mm with cells of {:g} mm have {:.0f} million cells; expected at most {} million",
        slices, size.x, size.y, cell.value(), cells / 1e6, most_cells / 1'000'000)}};
  }
  return FoamBlock(block, cell.value(), static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), slices);
}

std::size_t FoamBlock::needed_slices(double shift, Mm cell, double kerf) {
  constexpr double most_slices = 2000;
  const double at_once = std::min(2 * cell.value(), std::max(kerf / 2, cell.value() / 2));
  return static_cast<std::size_t>(std::clamp(std::ceil(shift / at_once) + 1, 2.0, most_slices));
}

Mm FoamBlock::usual_cell(const StockBlock& block, double shift, double kerf) {
  constexpr double most = 3.3e7;
  const Vector3 size = block.high - block.low;
  for (const double cell : {0.02, 0.05, 0.1, 0.2, 0.25, 0.5, 1.0, 2.0}) {
    const auto slices = static_cast<double>(needed_slices(shift, Mm(cell), kerf));
    if (size.x / cell * (size.y / cell) * slices <= most) return Mm(cell);
  }
  return Mm(5);
}

double FoamBlock::volume_of_cell() const {
  return cell_ * cell_ * (block_.high.z - block_.low.z) / (2.0 * static_cast<double>(slices_ - 1));
}

double FoamBlock::volume() const {
  double sum = 0;
  for (std::size_t slice = 0; slice < slices_; ++slice) {
    double of_slice = 0;
    for (std::size_t row = 0; row < rows_; ++row) {
      const float* const cells = clearance(row, slice);
      for (std::size_t column = 0; column < columns_; ++column) {
        of_slice += std::clamp(0.5 + double{cells[column]} / cell_, 0.0, 1.0);
      }
    }
    sum += of_slice * weight(slice);
  }
  return sum * volume_of_cell();
}

FoamPieces pieces_of(const FoamBlock& foam) {
  const std::size_t columns = foam.columns();
  const std::size_t rows = foam.rows();
  const std::size_t a_slice = columns * rows;
  Sets sets(a_slice * foam.slices());
  const float* const cells = foam.clearance(0, 0);
  const auto each = [&](auto&& use) {
    std::size_t cell = 0;
    for (std::size_t slice = 0; slice < foam.slices(); ++slice) {
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column, ++cell) {
          if (cells[cell] > 0) use(cell, column, row, slice);
        }
      }
    }
  };
  each([&](std::size_t cell, std::size_t column, std::size_t row, std::size_t slice) {
    const auto join = [&](std::size_t other) {
      if (cells[other] > 0) sets.join(static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(other));
    };
    if (column > 0) join(cell - 1);
    if (row > 0) join(cell - columns);
    if (slice > 0) join(cell - a_slice);
  });

  FoamPieces found;
  found.of = sets.take_numbers(cells, FoamPieces::none);
  each([&](std::size_t cell, std::size_t column, std::size_t row, std::size_t slice) {
    const std::uint32_t piece = found.of[cell];
    if (piece == found.pieces.size()) found.pieces.emplace_back();
    found.pieces[piece].cells += foam.weight(slice);
    found.pieces[piece].at_side |= column == 0 || row == 0 || column + 1 == columns || row + 1 == rows;
  });

  std::vector<std::uint32_t> order(found.pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return found.pieces[a].cells > found.pieces[b].cells; });
  std::vector<std::uint32_t> place(order.size());
  std::vector<FoamPieces::Piece> sorted;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    sorted.push_back(found.pieces[order[i]]);
  }
  found.pieces = std::move(sorted);
  for (std::uint32_t& piece : found.of) {
    if (piece != FoamPieces::none) piece = place[piece];
  }
  return found;
}

}  // namespace passo
