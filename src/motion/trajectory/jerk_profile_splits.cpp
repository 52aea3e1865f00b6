// JerkProfile: splits cells, where the motion changes much within one, or where a long cell meets a short one.
#include <algorithm>
#include <cmath>

#include "jerk_profile.hpp"

namespace passo {
namespace {

// Cells are split where the square of the speed would grow more.
constexpr double steepest = 6;
constexpr double most_unevenness = 2.5;

}  // namespace

// Splits cells that are too long: those in which the square of the speed changes much, by `guess_`, and those that
// exceed a limit although their share was lowered, with their neighbours. Returns whether there were any. Cells of the
// previous plan stay as they are, because that plan may have to continue. The number of cells is bounded by the effort
// that planning may take.
bool JerkProfile::split_coarse() {
  if (cells_.size() > effort_.most_cells) return false;
  std::ranges::sort(exceeded_);  // stretches that were lifted overlap
  const std::vector<double>& x = guess_;
  bool any = false;
  const std::size_t first = ends_.in_motion ? std::max<std::size_t>(planned_, 1) : 0;
  for (std::size_t i = cells_.size(); i-- > first;) {
    const double low = std::min(x[i], x[i + 1]);
    const bool is_steep = low > 0 && std::max(x[i], x[i + 1]) > steepest * low;
    const auto near = std::lower_bound(exceeded_.begin(), exceeded_.end(), std::max<std::size_t>(i, 1) - 1);
    const bool exceeds = near != exceeded_.end() && *near <= i + 1;
    if (!is_steep && !exceeds) continue;
    split(i);
    any = true;
  }
  return any;
}

// Splits a cell in two halves.
void JerkProfile::split(std::size_t i) {
  const auto at = [](auto& list, std::size_t k) { return list.begin() + static_cast<std::ptrdiff_t>(k); };
  JerkCell second = cells_[i];
  const double half = second.length / 2;
  second.start += half;
  second.length -= half;
  cells_[i].length = half;
  cells_[i].ends_segment = false;
  const std::vector<AxisShape> whole(shapes(i), shapes(i) + axes_.size());
  cells_.insert(at(cells_, i + 1), second);
  shapes_.insert(at(shapes_, (i + 1) * axes_.size()), whole.begin(), whole.end());
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    AxisShape& first = shapes(i)[k];
    AxisShape& last = shapes(i + 1)[k];
    const ShapeInside inside(whole[k], 2 * half);
    first.third_out = last.third_in = inside.third(0.5);
    first.bend_out = last.bend_in = inside.bend(0.5);
    first.slope_out = last.slope_in = inside.slope(0.5);
  }
  entry_cap_.insert(at(entry_cap_, i + 1), constant_speed_cap(i + 1));
}

// The acceleration cannot change evenly where a long cell meets a short one. Also, a window needs some cells.
void JerkProfile::even_out() {
  for (std::size_t i = 0; cells_.size() < fewest_cells;) split(i++ % cells_.size());
  const auto is_long = [this](std::size_t i) {
    const double length = cells_[i].length / most_unevenness;
    return (i > 0 && length > cells_[i - 1].length) || (i + 1 < cells_.size() && length > cells_[i + 1].length);
  };
  for (std::size_t i = 0; i < cells_.size();) {
    if (is_long(i)) {
      split(i);
      i -= std::min<std::size_t>(i, 1);
    } else {
      ++i;
    }
  }
}

}  // namespace passo
