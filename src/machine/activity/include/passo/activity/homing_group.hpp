// HomingGroup: a group of axes that are homed in the same turn, without those already homed. The axes first move
// together until one of them reaches its switch. They stop, and then the axes are checked one after the other to find
// which one it was.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "passo/machine_file/machine_description.hpp"

namespace passo {

class HomingGroup {
 public:
  // `axis` must outlive the turn.
  void add(const AxisDescription& axis) { axes_.push_back(&axis); }
  // Removes a homed axis. After the last one, the turn is cleared.
  void remove(const AxisDescription& axis) {
    std::erase(axes_, &axis);
    if (axes_.empty()) met_.reset();
  }
  const std::vector<const AxisDescription*>& axes() const { return axes_; }
  // Returns the next axis after this one; null: there is none.
  const AxisDescription* after(const AxisDescription& axis) const {
    const auto found = std::ranges::find(axes_, &axis);
    return found == axes_.end() || found + 1 == axes_.end() ? nullptr : *(found + 1);
  }

  void seek_together() { seeks_together_ = true; }
  bool seeks_together() const { return seeks_together_; }
  // Records the stop. `met`: the position of the axes when the first of them reached its switch. Empty: they did not
  // move.
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
