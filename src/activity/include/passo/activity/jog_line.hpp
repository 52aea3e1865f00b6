// JogLine: the path of a jog: straight, at the given speed, and only so far as the travel of the machine or the
// distance that is asked for.
//
// A jog needs a lease that is renewed; the session minds that. The path knows nothing of time.
#pragma once

#include "passo/activity/activity.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct JogWay {
  Point direction;       // of any length; on the axes that the machine has
  MmPerSecond speed{0};  // along it, above 0; the axes' limits hold
  Mm distance{0};        // 0: as far as the travel goes
};

class JogLine final : public Activity {
 public:
  // From rest at `start`, in machine coordinates. A direction that is 0 or leaves the travel at once is no motion.
  // `within_travel`: where the machine's place is not known, its travel says nothing.
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
