// Planner: segments -> phases. It finds the fastest motion along the path that keeps every axis within its limits. It
// looks ahead as far as braking needs, in bounded memory.
//
//   v²    top ________                 The path is cut into cells; in each cell v² is a straight line over the way.
//        /|           \______          Backwards, from the last known cell: the highest entry from which braking can
//       / |           |      \         still meet all later speeds. Forwards, from rest: the real speed, by
//      /  |           |       \        accelerating. Feed and velocities cap both. The path rests at corners (where
//     0 --+--cell-----+--------+-- s   directions of segments differ), after an exact stop and at actions.
//
// On a curve an axis needs part of its acceleration for turning; the rest is for speeding up and braking. So the
// possible speeds at the two ends of a cell are a small linear program in each direction (speed_window.hpp).
//
// Invariant: each move ends at a speed from which the queued cells can brake to rest. The motion is the same, bit for
// bit, as if the whole program had been planned at once, unless a queue of `most_queued_cells` did not reach the
// braking distance. Time: amortised constant for each cell. See docs/decisions/0010 and 0014.
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

  // Changes in mid-run. A move that was given stays as it is. The motion after it is planned anew from its end, on the
  // path and within the limits. So the caller decides how late a change takes effect: by how far it pulls ahead, and by
  // how long a move may be.

  // From now on no move is longer than this time.
  void limit_moves_to(Seconds duration);
  // Both factors multiply the feeds of segments that heed them; ranges 0 to 2 and 0 to 1. Rapids have a factor of
  // their own. Where the product is below a hundredth, the motion stands still as in a hold until the factor is raised.
  void set_feed_override(double factor);
  void set_adaptive_feed(double factor);
  // Multiplies the speed of rapids; above 0, at most 1.
  void set_rapid_override(double factor);
  // Multiplies the speed of segments with a SpindleLock: the ratio of the spindle's real speed to the commanded one.
  void set_spindle_ratio(double ratio);
  // Limits the speed along the path of all motion from here on, rapids included.
  void limit_speed_to(MmPerSecond speed);
  // Brakes to rest on the path. Until resume(), every next() then gives an Action of kind feed_hold. On segments that
  // do not heed a hold, the motion goes on to one that does.
  void hold();
  void resume();
  // Like hold(), but on any segment, whatever it heeds. Lasts until resume().
  void stop();
  // The path goes on where it ended until now with an await_line. That action is forgotten, and its place is passed as
  // in the mode `last`. Returns false, and changes nothing, where no such action comes next or where all motion before
  // it was given.
  bool go_on(PathMode last);
  // At rest in a hold: drops the rest of the path up to the next action. That action comes next after resume().
  void drop_to_action();

  // How to come to rest: as in a hold, or without limits of jerk, as soon as velocities and accelerations allow.
  enum class Braking { gentle, hard };
  // The motion by which the path would come to rest if it ended after the last move given. Changes nothing. Where there
  // is no hard way to rest, the way is gentle.
  void braking_plan(std::vector<PlannedMove>& plan, Braking how = Braking::gentle) const;
  // Forgets the path pulled so far and begins again, from rest, with the path's next item. Settings stay.
  void restart();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
