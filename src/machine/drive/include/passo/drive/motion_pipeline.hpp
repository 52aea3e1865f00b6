// MotionPipeline: the stages from a path to board items, in order: backlash, the rewindable path, stops after lines,
// the planner, the step generator. Taps between them show the data to observers.
//
// Position in the pipeline: the drive itself pulls nothing here. Its feed pulls items(), and thus runs all stages.
#pragma once

#include "passo/base/source.hpp"
#include "passo/base/tap.hpp"
#include "passo/drive/drive_options.hpp"
#include "passo/drive/line_stops.hpp"
#include "passo/drive/rewindable_path.hpp"
#include "passo/path/backlash_compensator.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class MotionPipeline {
 public:
  // `path` must outlive the pipeline.
  MotionPipeline(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                 const DriveOptions& options);
  MotionPipeline(const MotionPipeline&) = delete;
  MotionPipeline& operator=(const MotionPipeline&) = delete;

  Tap<PathItem>& path_items() { return path_items_; }
  Tap<MotionItem>& motion() { return motion_; }
  Tap<BoardItem>& items() { return items_; }

  RewindablePath& path() { return path_; }
  LineStops& line_stops() { return line_stops_; }
  Planner& planner() { return planner_; }
  StepGenerator& generator() { return generator_; }
  const StepGenerator& generator() const { return generator_; }

 private:
  BacklashAtRest backlash_at_rest(const StepOptions& steps) const;

  Tap<PathItem> path_items_;
  BacklashCompensator backlash_compensator_;  // stops where an axis with backlash reverses
  RewindablePath path_;
  LineStops line_stops_;
  Planner planner_;  // segments -> phases
  Tap<MotionItem> motion_;
  StepGenerator generator_;  // phases -> board segments
  Tap<BoardItem> items_;
};

}  // namespace passo
