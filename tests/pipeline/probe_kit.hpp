// What probe tests have in common: bodies to touch, and an oracle that counts steps by itself.
#pragma once

#include <cmath>
#include <vector>

#include "passo/activity/touchable.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo::test {

inline TouchBox below(Axis axis, double high) {
  TouchBox box;
  box.ranges[axis].high = high;
  return box;
}

// Counts steps by itself, and keeps where the machine was when it got into the box, in millimetres.
class ContactOracle final : public MachineObserver {
 public:
  ContactOracle(const MachineDescription& machine, const TouchBox& box) : machine_(machine), box_(box) {}

  void on_steps(Ticks /*time*/, std::uint8_t stepped, std::uint8_t directions) override {
    for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
      const bool up = ((directions >> m & 1U) != 0) == machine_.axes[m].inverted;
      if ((stepped >> m & 1U) != 0) steps_[machine_.axes[m].axis] += up ? 1 : -1;
    }
    const bool now = inside();
    if (now != inside_) (now ? contacts : releases).push_back(place());
    inside_ = now;
  }

  std::vector<Point> contacts;
  std::vector<Point> releases;

  Point place() const {
    Point place;
    for (const AxisDescription& axis : machine_.axes) place[axis.axis] = steps_[axis.axis] / axis.steps_per_unit;
    return place;
  }

 private:
  bool inside() const {
    const Point at = place();
    for (const AxisDescription& axis : machine_.axes) {
      const TouchBox::Range& range = box_.ranges[axis.axis];
      if (at[axis.axis] < range.low - 1e-9 || at[axis.axis] > range.high + 1e-9) return false;
    }
    return true;
  }

  const MachineDescription& machine_;
  const TouchBox& box_;
  PerAxis<double> steps_;
  bool inside_ = false;
};

}  // namespace passo::test
