// HomingRepeats: the repeatability of homing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/homing_path.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

// The closing positions of an axis' switch relative to that of the first homing, by the board's counts, in thousandths
// of a millimetre or degree.
struct AxisRepeats {
  Axis axis = Axis::x;
  unsigned homings = 0;
  double last = 0;  // relative to the previous homing
  double mean = 0;
  double spread = 0;  // highest minus lowest
  std::int64_t spread_steps = 0;
};

class HomingRepeats {
 public:
  // `machine` must outlive this object.
  explicit HomingRepeats(const MachineDescription& machine) : machine_(machine) {}

  // Adds a homing. `stood`: the position before it, relative to the previous homing. Empty: unknown, so this homing
  // becomes the first.
  void record(const std::vector<HomedAxis>& homed, const std::optional<Point>& stood);
  // One entry for each axis that was homed every time.
  std::vector<AxisRepeats> axes() const;

 private:
  struct Places {
    Axis axis = Axis::x;
    unsigned homings = 0;
    std::int64_t last = 0;   // steps relative to the previous homing
    std::int64_t place = 0;  // steps relative to the first homing
    std::int64_t sum = 0;    // sum of the positions
    std::int64_t low = 0;
    std::int64_t high = 0;
  };
  const MachineDescription& machine_;
  unsigned homings_ = 0;
  std::vector<Places> places_;
};

// A line of text for an axis, without a newline.
std::string describe(const AxisRepeats& repeats);

}  // namespace passo
