// GrblPlanner: predicts the motion that a board with Grbl plans from the lines that it receives.
//
// Position in the pipeline: a branch after the path builder. Our planner takes no part in it: such a board plans with
// constant acceleration, looks ahead over a small number of blocks (15 in Grbl on an Uno, 100 in grblHAL), and limits
// the speed at junctions by its junction deviation. Its times therefore differ from those of our boards, and depend on
// how many blocks it holds and on when the lines arrive.
//
// The model is the published behaviour of Grbl 1.1, in continuous time:
// - Positions are rounded to steps, so short lines have the directions that the board sees.
// - The speed at a junction is at most sqrt(a d s/(1 - s)): s is the sine of half the angle between the lines, d the
//   junction deviation, a the acceleration along the difference of the directions.
// - The board must be able to stop at the end of the last block that it holds. A block that arrives extends the plan,
//   also that of the block that moves.
// - An arc becomes chords within the arc tolerance.
// - Built for a CoreXY, the board plans the motion of the motors.
// Junctions break acceleration limits by up to several times; the model does not hide this.
//
// Invariants: at most `blocks` blocks are held; no block moves faster than its feed or the limits of its axes; time
// does not go back. Cost per block: 0.1 us, plus 5 ns for each held block whose speed changes.
// Source: S. K. Jeon, "Improving Grbl: Cornering Algorithm" (2011); Grbl's wiki on its settings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Settings of the board. An axis exists if its steps per unit are above 0.
struct GrblLimits {
  PerAxis<double> steps_per_mm = {};        // $100 …, steps per mm or degree
  PerAxis<MmPerSecond> velocity = {};       // $110 …
  PerAxis<MmPerSecond2> acceleration = {};  // $120 …
  Mm junction_deviation{0.01};              // $11
  Mm arc_tolerance{0.002};                  // $12
  std::size_t blocks = 15;                  // blocks that the planner holds, including the one that moves; at least 1
  double feed_factor = 1;                   // overrides; above 0
  double rapid_factor = 1;
  // The motors of X and Y move by x + y and x - y. Lengths are measured along the motors, and the limits of X and Y are
  // theirs.
  bool core_xy = false;
  bool feeds_tool = false;  // then F is the speed of the tool, as in grblHAL, not along the motors, as in Grbl

  // Returns a way of the tool as the board measures it.
  Point measured(Point way) const;
  // Returns the feed along the motors for a move of the tool.
  MmPerSecond measured_feed(const Point& way, MmPerSecond feed) const;
  bool operator==(const GrblLimits&) const = default;
};

// A straight move of the board, from step to step.
struct GrblBlock {
  std::uint32_t source = 0;  // as passed to the planner: the number of the line
  bool rapid = false;
  MmPerSecond feed{0};  // as programmed
  Point start;
  Point end;
  Mm length{0};  // as the board measures it, like `feed` and `acceleration`
  MmPerSecond2 acceleration{0};
  double scale = 1;  // the tool's way for each mm of `length`
};

// A part of the tool's motion along a block, with constant acceleration. Phases follow each other; between two of them
// the board may rest.
struct GrblPhase {
  const GrblBlock& block;
  Seconds begun{0};
  Seconds duration{0};
  Mm from{0};  // along the block
  MmPerSecond speed{0};
  MmPerSecond2 acceleration{0};

  MmPerSecond end_speed() const { return speed + acceleration * duration; }
  Mm end() const { return from + (speed + end_speed()) / 2 * duration; }
};

class GrblPlanner {
 public:
  struct Arc {
    Axis first = Axis::x;  // the plane, as in Curve::ArcData
    Axis second = Axis::y;
    double first_center = 0;  // relative to the start of the arc
    double second_center = 0;
    bool clockwise = false;
  };

  // The board rests at `start`.
  GrblPlanner(const GrblLimits& limits, const Point& start);

  // Sets a listener, which receives all phases in the order of the motion.
  void hear(std::function<void(const GrblPhase&)> listener) { listener_ = std::move(listener); }

  // Calls `add` with the end of each chord of an arc.
  static void each_chord(const Arc& arc, const Point& start, const Point& end, Mm tolerance,
                         const std::function<void(const Point&)>& add);

  // The functions below take the time at which the board has read the line, and return the time at which it has
  // processed it, i.e. when it answers. Times must not decrease.

  // Adds a straight move. `feed`: infinite for a rapid.
  Seconds add_line(const Point& end, MmPerSecond feed, std::uint32_t source, Seconds when);
  // Adds an arc. If its ends are equal, it is a full circle.
  Seconds add_arc(const Arc& arc, const Point& end, MmPerSecond feed, std::uint32_t source, Seconds when);
  // Waits until the board rests, then for `dwell`.
  Seconds wait_for_rest(Seconds dwell, Seconds when);

  // The functions below serve who follows a board in time, and adds a line only when it has a free block.
  bool full() const { return blocks_.size() >= limits_.blocks; }
  bool empty() const { return blocks_.empty(); }
  Seconds now() const { return Seconds(now_); }
  // Moves until that time.
  void run(Seconds when) { run_until(when.value()); }
  // When the first block ends; not without a block.
  Seconds first_end() const { return Seconds(now_ + profile().time()); }
  // When the board rests if nothing more is added.
  Seconds rest_at() const;
  // The source of the block that moves, and how far along the block the motion is; not without a block.
  std::uint32_t source() const { return blocks_.front().motion.source; }
  Mm done_of_first() const { return Mm(done_of_first_ * blocks_.front().motion.scale); }

 private:
  struct Block {
    GrblBlock motion;
    double nominal2 = 0;  // squares of speeds
    double most_entry2 = 0;
    double entry2 = 0;  // planned
    double gain2() const { return 2 * motion.acceleration.value() * motion.length.value(); }
  };
  // The rest of the first block: accelerate to `top`, keep the speed, decelerate to `exit`.
  struct Profile {
    double top = 0;
    double exit = 0;
    double up = 0;  // s
    double level = 0;
    double down = 0;
    double time() const { return up + level + down; }
  };

  double limit_along(const Point& direction, const PerAxis<double>& limits) const;
  double junction2(const Point& direction) const;
  void plan();
  Profile profile() const { return profile(0, done_of_first_, speed_); }
  Profile profile(std::size_t index, double done, double speed) const;
  void run_until(double when);
  void move_first(const Profile& profile, double time);
  void add_phase(double acceleration, double time);
  void end_first(const Profile& profile);
  Point rounded(const Point& place) const;

  GrblLimits limits_;
  PerAxis<double> fastest_{};
  PerAxis<double> strongest_{};
  Point at_;         // end of the last line, not rounded
  Point last_step_;  // the same, rounded to steps
  Point direction_;  // of the last block
  double nominal2_ = 0;
  std::deque<Block> blocks_;  // the first one moves
  double now_ = 0;            // time of the motion, s
  double speed_ = 0;
  double done_of_first_ = 0;  // mm
  std::function<void(const GrblPhase&)> listener_;
};

}  // namespace passo
