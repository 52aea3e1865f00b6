// HomingTurn: the axes of one turn that are not homed yet. Several axes first seek their switches together until one of
// them meets its own. They rest then, and one after the other is looked at to find out which one it was.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

class HomingTurn {
 public:
  // `axis` outlives the turn.
  void add(const AxisDescription& axis) { axes_.push_back(&axis); }
  // The axis is homed. After the last one nothing of the turn counts any more.
  void remove(const AxisDescription& axis) {
    std::erase(axes_, &axis);
    if (axes_.empty()) met_.reset();
  }
  const std::vector<const AxisDescription*>& axes() const { return axes_; }
  // The axis that comes after this one; null: none.
  const AxisDescription* after(const AxisDescription& axis) const {
    const auto found = std::ranges::find(axes_, &axis);
    return found == axes_.end() || found + 1 == axes_.end() ? nullptr : *(found + 1);
  }

  void seek_together() { seeks_together_ = true; }
  bool seeks_together() const { return seeks_together_; }
  // `met`: where the axes were when the first of them met its switch. Empty: they did not move.
  void rest(const std::optional<Point>& met) {
    seeks_together_ = false;
    if (met) met_ = met;
  }
  const std::optional<Point>& met() const { return met_; }

 private:
  std::vector<const AxisDescription*> axes_;
  bool seeks_together_ = false;
  std::optional<Point> met_;
};

}  // namespace passo
