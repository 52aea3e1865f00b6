#include "passo/stock/wall_heights.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr std::size_t squares = 3;  // of a patch, along an axis
constexpr std::size_t points = squares * WallHeights::parts + 1;
// A patch takes 1.2 KiB: at most six bytes for each cell of the field.
constexpr std::size_t cells_a_patch = 200;
constexpr std::size_t always_allowed = 64;
// A wall is at least as high as a square is wide.
constexpr double least_height = 1;

// The heights at the centres of a lattice, below the top.
struct CentreLattice {
  const HeightField& field;
  std::size_t step;
  std::size_t first_column;
  std::size_t first_row;

  CentreLattice(const HeightField& of, std::size_t every)
      : field(of),
        step(every),
        first_column(WallHeights::first_place(of.columns(), every)),
        first_row(WallHeights::first_place(of.rows(), every)) {}
  // Centres along the axes.
  std::size_t across() const { return (field.columns() - 1 - first_column) / step + 1; }
  std::size_t up() const { return (field.rows() - 1 - first_row) / step + 1; }
  float at(std::size_t i, std::size_t j) const {
    return field.below_top(first_row + j * step)[first_column + i * step];
  }
};

// Whether the heights of neighbours b and c jump. On a slope they also differ from a and d beside them.
bool is_jump(float a, float b, float c, float d, float least) {
  const float sign = c > b ? 1.0F : -1.0F;
  const float rise = sign * (c - b);
  return rise >= least && rise > 2 * std::max(sign * (b - a), sign * (d - c));
}

}  // namespace

std::size_t WallHeights::first_place(std::size_t cells, std::size_t step) {
  return std::min(step / 2, cells - 1);
}

Mm WallHeights::patch_size() const {
  return spacing_ * static_cast<double>(squares * parts);
}

// Returns the number of patches that hold them.
std::size_t WallHeights::find_walls(const HeightField& field, std::size_t step, double height) {
  const CentreLattice lattice(field, step);
  const auto least = static_cast<float>(height * static_cast<double>(step) * field.cell());
  std::fill(is_wall_.begin(), is_wall_.end(), false);
  std::fill(patch_at_.begin(), patch_at_.end(), 0U);
  std::size_t count = 0;
  const auto mark = [&](std::size_t across, std::size_t up) {
    if (across >= across_ || up >= up_) return;
    is_wall_[up * across_ + across] = true;
    std::uint32_t& patch = patch_at_[up / squares * patches_across_ + across / squares];
    if (patch == 0) patch = static_cast<std::uint32_t>(++count);
  };
  for (std::size_t j = 0; j <= up_; ++j) {
    for (std::size_t i = 0; i <= across_; ++i) {
      const float here = lattice.at(i, j);
      // The side of a square, to the right or up, is a side of the square before it, too.
      if (i < across_ && is_jump(lattice.at(i > 0 ? i - 1 : i, j), here, lattice.at(i + 1, j),
                                 lattice.at(std::min(i + 2, across_), j), least)) {
        mark(i, j);
        if (j > 0) mark(i, j - 1);
      }
      if (j < up_ && is_jump(lattice.at(i, j > 0 ? j - 1 : j), here, lattice.at(i, j + 1),
                             lattice.at(i, std::min(j + 2, up_)), least)) {
        mark(i, j);
        if (i > 0) mark(i - 1, j);
      }
    }
  }
  return count;
}

void WallHeights::add_patches(const HeightField& field, std::size_t step) {
  const CentreLattice lattice(field, step);
  const double half = 0.5 * spacing_.value();
  const double size = spacing_.value() * static_cast<double>(points);
  std::uint32_t count = 0;
  for (std::size_t place = 0; place < patch_at_.size(); ++place) {
    if (patch_at_[place] == 0) continue;
    const std::size_t column = lattice.first_column + place % patches_across_ * squares * step;
    const std::size_t row = lattice.first_row + place / patches_across_ * squares * step;
    const Vector3 low{field.x_of(column) - half, field.y_of(row) - half, field.bottom()};
    auto heights = HeightField::create({low, {low.x + size, low.y + size, field.top()}}, spacing_);
    patch_at_[place] = ++count;
    patches_.push_back({.column = column, .row = row, .heights = std::move(*heights)});
  }
}

WallHeights WallHeights::at_walls_of(const HeightField& field, std::size_t step) {
  // The sizes that a cell may have.
  constexpr Mm least_spacing{1e-3};
  constexpr Mm largest_spacing{10};
  const Mm spacing(field.cell() * static_cast<double>(step) / static_cast<double>(parts));
  const CentreLattice lattice(field, step);
  WallHeights walls;
  if (spacing < least_spacing || spacing > largest_spacing) return walls;
  walls.spacing_ = spacing;
  walls.across_ = lattice.across() - 1;
  walls.up_ = lattice.up() - 1;
  walls.patches_across_ = (walls.across_ + squares - 1) / squares;
  walls.is_wall_.resize(walls.across_ * walls.up_);
  walls.patch_at_.resize(walls.patches_across_ * ((walls.up_ + squares - 1) / squares));
  const std::size_t most = always_allowed + field.columns() * field.rows() / cells_a_patch;
  double height = least_height;
  while (walls.find_walls(field, step, height) > most) height *= 2;
  walls.add_patches(field, step);
  return walls;
}

double WallHeights::height(std::size_t across, std::size_t up, std::size_t i, std::size_t j) const {
  const std::uint32_t patch = patch_at_[up / squares * patches_across_ + across / squares];
  return patches_[patch - 1].heights.height(across % squares * parts + i, up % squares * parts + j);
}

}  // namespace passo
