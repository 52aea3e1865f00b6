// JogLine: the path of a jog. The path is straight, at the given speed, and ends at the end of the machine's travel or
// after the requested distance.
//
// A jog needs a lease that is renewed. The session minds the lease; the path knows nothing of time.
#pragma once

#include "passo/activity/activity.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct JogWay {
  Point direction;       // of any length; on the axes that the machine has
  MmPerSecond speed{0};  // along the direction, above 0; the axes' limits hold
  Mm distance{0};        // 0: as far as the travel goes
};

class JogLine final : public Activity {
 public:
  // Begins at rest at `start`, in machine coordinates. A direction that is 0 or leaves the travel at once gives no
  // motion. `within_travel` false: the machine's place is not known, so its travel does not limit where the jog ends.
  JogLine(const MachineDescription& machine, const Point& start, const JogWay& way, bool within_travel = true);

  ActivityKind kind() const override { return ActivityKind::jog; }
  [[nodiscard]] bool next(PathItem& item) override;
  // Where the jog ends if nobody stops it.
  const Point& target() const { return target_; }

 private:
  Point start_;
  Point target_;
  MmPerSecond speed_;
  bool given_ = false;
};

}  // namespace passo
