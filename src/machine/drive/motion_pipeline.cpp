#include "passo/drive/motion_pipeline.hpp"

#include "passo/drive/backlash_options.hpp"

namespace passo {
namespace {

BacklashOptions backlash_of(StepOptions steps, const MotionLimits& limits, const DriveOptions& options) {
  if (options.begin_at) steps.downs = AxisSet();
  const Smoothness smoothness = limits.limits_jerk() ? Smoothness::slow_bending : Smoothness::least_bending;
  return backlash_options(steps, smoothness, options.tails || options.begin_at);
}

}  // namespace

MotionPipeline::MotionPipeline(Source<PathItem>& path, const MotionLimits& limits, const StepOptions& steps,
                               const DriveOptions& options)
    : path_items_(path),
      backlash_compensator_(path_items_, backlash_of(steps, limits, options)),
      path_(backlash_compensator_),
      line_stops_(path_),
      planner_(line_stops_, limits),
      motion_(planner_),
      generator_(motion_, steps),
      items_(generator_) {
  if (options.begin_at || options.may_stop_at_lines) path_.keep();
  if (options.begin_at) path_.begin_at(*options.begin_at, options.lead_in);
  if (!options.tails && !options.may_stop_at_lines) path_.forget_passed();
  line_stops_.stop_at_lines(options.stops_at_lines);
  backlash_compensator_.ask_after_probe([this, motors = steps] { return backlash_at_rest(motors); });
}

BacklashAtRest MotionPipeline::backlash_at_rest(const StepOptions& steps) const {
  const AxisSet downs = generator_.downs();
  return {.downs = downs, .place = steps.kinematics.axes(generator_.place().exact(), downs, steps.start)};
}

}  // namespace passo
