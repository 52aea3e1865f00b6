// PlannedProgram: the whole motion of a program that was checked, as the session would plan it for a run without
// changes in mid-run. For all who want to know of it before, or without, a run.
//
// Place: beside the session, and made of the same stages: program, backlash, planner.
#pragma once

#include <cstdint>
#include <functional>

#include "passo/activity/program.hpp"
#include "passo/path/backlash_taker.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

// The overrides that change how fast a program moves. 1: 100 %.
struct MotionFactors {
  double feed = 1;
  double rapids = 1;
  friend bool operator==(const MotionFactors&, const MotionFactors&) = default;
};

class PlannedProgram final : public Source<MotionItem> {
 public:
  // `machine`, `options` and `check`, that of this program, outlive this.
  PlannedProgram(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                 const ProgramCheck& check, const MotionFactors& factors = {});

  // A loop that only a probe ends goes on as far as the check has followed it.
  [[nodiscard]] bool next(MotionItem& item) override;

  // For watchers. They are added before the first next().
  Tap<Operation>& operations() { return activity_.operations(); }
  Tap<PathItem>& path() { return activity_.path(); }
  // Of what was planned so far.
  Seconds nominal_time() const { return activity_.nominal_time(); }

 private:
  const ProgramCheck& check_;
  Diagnostics findings_;  // after a good check only what is known already
  Program activity_;
  BacklashTaker path_with_rests_;
  Planner planner_;
  std::uint64_t segments_ = 0;
};

}  // namespace passo
