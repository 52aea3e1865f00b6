// JogLine: the path of a jog. The path is straight, at the given speed, and ends at the end of the machine's travel or
// after the requested distance.
//
// The session monitors the jog's keep-alive timeout; the path is independent of time.
#pragma once

#include "passo/activity/activity.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct JogWay {
  Point direction;       // of any length, along axes of the machine
  MmPerSecond speed{0};  // along the direction, above 0; the axes' limits apply
  Mm distance{0};        // 0: to the end of the travel
};

class JogLine final : public Activity {
 public:
  // Starts at `start`, in machine coordinates. A direction that is 0 or leaves the travel immediately gives no motion.
  // `within_travel` false: the position is unknown, so the travel does not limit the jog.
  JogLine(const MachineDescription& machine, const Point& start, const JogWay& way, bool within_travel = true);

  ActivityKind kind() const override { return ActivityKind::jog; }
  [[nodiscard]] bool next(PathItem& item) override;
  // The end of the jog if it is not stopped.
  const Point& target() const { return target_; }

 private:
  Point start_;
  Point target_;
  MmPerSecond speed_;
  bool given_ = false;
};

}  // namespace passo
