// ProgramMotion: the whole motion of a checked program, for views and reports before, or without, a run. Its sources
// are our planner (PlannedProgram), and the forecast for a board that plans by itself.
#pragma once

#include <functional>

#include "passo/base/source.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/path/segment.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class ProgramMotion : public Source<MotionItem> {
 public:
  // Observers must be added before the first next().
  virtual void watch_operations(std::function<void(const Operation&)> watcher) = 0;
  virtual void watch_path(std::function<void(const PathItem&)> watcher) = 0;
  // The nominal time of the motion planned so far.
  virtual Seconds nominal_time() const = 0;
};

}  // namespace passo
