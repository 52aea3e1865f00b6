// ProbeLine: one straight probe move, as an activity.
#pragma once

#include "passo/activity/activity.hpp"
#include "passo/interpreter/machine_answers.hpp"

namespace passo {

class ProbeLine final : public Activity {
 public:
  // From rest at `start` to `target`, machine coordinates, until the probe is touched; else until it is free. `answers`
  // outlives it.
  ProbeLine(const Point& start, const Point& target, MmPerSecond speed, bool toward, const MachineAnswers& answers)
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
  const MachineAnswers& answers_;
  Step step_ = Step::begin;
};

}  // namespace passo
