// PlannedProgram: the whole motion of a checked program, as the session would plan it for a run without changes. It is
// for views and reports before, or without, a run.
//
// It uses the same stages as the session: program, backlash, planner.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "passo/activity/program.hpp"
#include "passo/path/backlash_compensator.hpp"
#include "passo/session/program_motion.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// The overrides that change how fast a program moves. 1: 100 %.
struct MotionFactors {
  double feed = 1;
  double rapids = 1;
  friend bool operator==(const MotionFactors&, const MotionFactors&) = default;
};

class PlannedProgram final : public ProgramMotion {
 public:
  // `machine`, `options` and the program's `check` must outlive this object.
  PlannedProgram(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                 const ProgramCheck& check, const MotionFactors& factors = {});

  // If the program probes, the motion ends after as many segments as in the check, because a loop that only a probe
  // result can end would be endless.
  [[nodiscard]] bool next(MotionItem& item) override;

  // For observers, which must be added before the first next().
  Tap<Operation>& operations() { return activity_.operations(); }
  Tap<PathItem>& path() { return activity_.path(); }
  void watch_operations(std::function<void(const Operation&)> watcher) override {
    operations().watch(std::move(watcher));
  }
  void watch_path(std::function<void(const PathItem&)> watcher) override { path().watch(std::move(watcher)); }
  Seconds nominal_time() const override { return activity_.nominal_time(); }

 private:
  const ProgramCheck& check_;
  Diagnostics findings_;  // after a good check only known findings
  Program activity_;
  BacklashCompensator path_with_rests_;
  Planner planner_;
  std::uint64_t segments_ = 0;
};

}  // namespace passo
