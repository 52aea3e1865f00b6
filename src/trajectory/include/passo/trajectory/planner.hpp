// Planner: segments -> phases. The fastest motion along the path that keeps every axis within its limits; look-ahead as
// far as braking needs, in bounded memory.
//
//   v²    top ________                 The path is cut into cells; in each, v² is a straight line over the way.
//   Backwards
//        /|           \______          from the last cell known: how fast may each be entered so that all speeds after
//        it
//       / |           |      \         can still be met (braking)? Forwards: how fast is it really, from rest on
//      /  |           |       \        (accelerating)? Feed and velocities cap both. Where directions of segments
//     0 --+--cell-----+--------+-- s   differ (corners), after an exact stop and at actions the path rests.
//
// On a curve an axis needs part of its acceleration for turning and has the rest for speeding up and braking: what is
// possible at the two ends of a cell is a small linear program each way (speed_window.hpp).
//
// Invariant: what is given ends at a speed from which the cells queued behind it can brake to rest, and is the
// same, bit for bit, as if the whole program had been planned at once, except after a queue of `most_queued_cells`
// did not reach the braking distance. Time: amortised constant a cell. See docs/decisions/0010 and 0014.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class Planner final : public Source<MotionItem> {
 public:
  // About 110 bytes each, 40 for each axis and 40 more, and 570 for each segment: 26 MiB when full of short segments of
  // three axes. It grows as it is needed.
  static constexpr std::size_t most_queued_cells = 30'000;

  Planner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued = most_queued_cells);
  ~Planner() override;

  [[nodiscard]] bool next(MotionItem& item) override;

  // In mid-run. A move that was given stays as it is; what follows is planned anew from its end, on the path and within
  // the limits. How late a change takes effect is so for the caller to say: by how much it pulls ahead, and by
  // how long a move may be.

  // From now on a move ends after this time at the latest.
  void limit_moves_to(Seconds duration);
  // Feeds are multiplied by both factors, 0 to 2 and 0 to 1, where their segments heed them; rapids stay as they are.
  // Where that makes less than a hundredth, the motion stands as in a hold, until it is raised.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // The speed of segments with a SpindleLock, a multiple of what they say: the spindle is not as fast as commanded.
  void set_spindle_ratio(double ratio);
  // Of all motion from here on, rapids included, along the path.
  void limit_speed_to(MmPerSecond speed);
  // Brakes to rest on the path; then next() gives an Action of kind feed_hold, however often, until resume(). Waits
  // where the segment does not heed it.
  void hold();
  void resume();
  // A hold wherever it is, whatever its segments heed, until resume().
  void stop();
  // At rest in a hold: drops what is left of the path up to the next action, which comes next after resume().
  void drop_to_action();

  // How the path would come to rest behind the last move given if it were held now. Nothing changes by it.
  void braking_plan(std::vector<PlannedMove>& plan) const;
  // Forgets what it has pulled and begins again, from rest, with what the path gives next. Settings stay.
  void restart();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
