// Planner: converts segments into phases. It finds the fastest motion along the path that keeps every axis within its
// limits, and looks ahead as far as the braking distance, in bounded memory.
//
//   v²    top ________                 The path is cut into cells; in each cell v² is linear in the distance.
//        /|           \______          Backwards, from the last known cell: the highest entry from which deceleration
//       / |           |      \         can still meet all later speeds. Forwards, from rest: the actual speed,
//      /  |           |       \        by accelerating. Feed and velocities limit both. The path stops at corners
//     0 --+--cell-----+--------+-- s   (where segment directions differ), after an exact stop and at actions.
//
// On a curve, an axis needs part of its acceleration to change direction; the remainder is available for acceleration
// and deceleration. The possible speeds at the two ends of a cell are a small linear program in each direction
// (speed_window.hpp).
//
// Invariant: each move ends at a speed from which the queued cells can brake to rest. The motion is bit-identical to
// that of a whole program planned at once, unless a queue of `most_queued_cells` did not reach the braking distance.
// Time: amortised constant for each cell. See docs/decisions/0010 and 0014.
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
  // A cell takes about 110 bytes, 40 for each axis and 40 more; a segment takes 570. A queue full of short segments of
  // three axes takes 26 MiB. It grows only as needed.
  static constexpr std::size_t most_queued_cells = 30'000;

  Planner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued = most_queued_cells);
  ~Planner() override;

  [[nodiscard]] bool next(MotionItem& item) override;

  // Real-time changes. A returned move stays unchanged. The motion after it is planned again from its end, on the path
  // and within the limits. The delay of a change thus depends on how far the caller pulls ahead, and on the longest
  // move.

  // From now on no move is longer than this time.
  void limit_moves_to(Seconds duration);
  // Both factors multiply the feeds of segments for which they are enabled; ranges 0 to 2 and 0 to 1. Rapids have a
  // separate factor. If the product is below 0.01, motion stops as in a hold until it is raised.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // Multiplies the speed of rapids; above 0, at most 1.
  void set_rapid_override(double factor);
  // Multiplies the speed of segments with a SpindleLock: the ratio of the spindle's real speed to the commanded one.
  void set_spindle_ratio(double ratio);
  // Limits the speed along the path of all motion from here on, rapids included.
  void limit_speed_to(MmPerSecond speed);
  // Stops on the path. Until resume(), every next() then returns an Action of kind feed_hold. On segments on which
  // holds are disabled, motion continues to the first one on which they are enabled.
  void hold();
  void resume();
  // Like hold(), but on any segment. Lasts until resume().
  void stop();
  // Continues a path that ended with an await_line: the action is dropped, and its point is passed in the mode `last`.
  // Returns false, and changes nothing, if no such action comes next or all motion before it was returned.
  bool go_on(PathMode last);
  // While stopped in a hold: drops the path up to the next action, which comes next after resume().
  void drop_to_action();

  // How to stop: as in a hold, or without jerk limits, as soon as the velocities and accelerations allow.
  enum class Braking { gentle, hard };
  // The motion that would stop the machine if the path ended after the last returned move. Changes nothing. If a hard
  // stop is not possible, it is gentle.
  void braking_plan(std::vector<PlannedMove>& plan, Braking how = Braking::gentle) const;
  // Drops the path pulled so far and begins again from standstill with the path's next item. Settings are kept.
  void restart();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
