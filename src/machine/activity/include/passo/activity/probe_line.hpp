// ProbeLine: one straight probe move, as an activity.
#pragma once

#include "passo/activity/activity.hpp"
#include "passo/interpreter/machine_results.hpp"

namespace passo {

class ProbeLine final : public Activity {
 public:
  // Moves from a stop at `start` towards `target`, in machine coordinates. `toward` true: until the probe is triggered;
  // false: until the probe is open. `answers` must outlive the ProbeLine.
  ProbeLine(const Point& start, const Point& target, MmPerSecond speed, bool toward, const MachineResults& answers)
      : start_(start), target_(target), speed_(speed), toward_(toward), answers_(answers) {}

  ActivityKind kind() const override { return ActivityKind::probing; }
  [[nodiscard]] bool next(PathItem& item) override;
  std::optional<ActivityFault> fault() const override;

 private:
  enum class Step : std::uint8_t { begin, move, end, done };

  Point start_;
  Point target_;
  MmPerSecond speed_;
  bool toward_;
  const MachineResults& answers_;
  Step step_ = Step::begin;
};

}  // namespace passo
