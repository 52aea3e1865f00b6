// HomingRepeats: how well a machine finds its place again when it is homed several times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/homing_path.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// The places where the switch of an axis closed, measured from where it closed at the first homing, by the board's
// counts. Thousandths of a millimetre or of a degree.
struct AxisRepeats {
  Axis axis = Axis::x;
  unsigned homings = 0;
  double last = 0;  // from where it closed at the homing before
  double mean = 0;
  double spread = 0;  // from the lowest to the highest
  std::int64_t spread_steps = 0;
};

class HomingRepeats {
 public:
  // `machine` outlives this.
  explicit HomingRepeats(const MachineDescription& machine) : machine_(machine) {}

  // Adds a homing. `stood`: where the machine stood before, as it was counted from the homing before. Empty: that was
  // not known, so this homing counts as the first.
  void record(const std::vector<HomedAxis>& homed, const std::optional<Point>& stood);
  // One for each axis that all homings have found.
  std::vector<AxisRepeats> axes() const;

 private:
  struct Places {
    Axis axis = Axis::x;
    unsigned homings = 0;
    std::int64_t last = 0;   // steps, from the homing before
    std::int64_t place = 0;  // steps, from the first homing
    std::int64_t sum = 0;    // of the places
    std::int64_t low = 0;
    std::int64_t high = 0;
  };
  const MachineDescription& machine_;
  unsigned homings_ = 0;
  std::vector<Places> places_;
};

// A line for an axis, without its end.
std::string describe(const AxisRepeats& repeats);

}  // namespace passo
