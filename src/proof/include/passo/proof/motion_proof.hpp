// MotionProver: watches a job from the side and measures what its motion really does.
//
// It is the referee of the planner and the path smoother and shares no code with either: curves are evaluated by
// formulas of its own, steps are replayed from the definition in wire/board_segment.hpp, and the time is compared with
// the shortest possible on the same path. docs/motion-proof.md has every formula.
//
// Place on the street: beside it. Feed it, in the order in which they come, the programmed path (Job::path()), the
// planned motion (Job::motion()) and the board items (Job::board()); no item of the motion comes before the segments
// of the path that it plays. Memory is bounded: a window of the path, whatever the length of the job.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/units/units.hpp"

namespace passo {

// What one motor of the board and its axis may do. A limit of 0 is none.
struct ProvenAxis {
  Axis axis = Axis::x;
  Mm step{0};  // the way of one step; 0: the steps are not looked at
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};
  // Where it falls with the speed: never rising, above 0 up to `velocity`. Empty: `acceleration` at all speeds.
  std::function<MmPerSecond2(MmPerSecond)> acceleration_at = {};
};
struct ProofOptions {
  std::vector<ProvenAxis> axes;  // in the order of the board's motors
  Hertz tick_rate{16e6};
};

// The worst that was found of one kind: the largest, or where the limit changes with the speed the largest multiple of
// the limit there. In the units of its kind: mm (or degrees) and seconds.
struct Finding {
  double value = 0;
  double limit = 0;        // 0: there is none
  Seconds time{0};         // of the motion
  std::uint32_t line = 0;  // of the program; 0: not known

  double multiple() const { return limit > 0 ? value / limit : 0; }
};

struct AxisProof {
  Axis axis = Axis::x;
  // Inside the phases.
  Finding velocity;
  Finding acceleration;
  Finding jerk;
  // From one phase to the next.
  Finding velocity_jump;      // the limit is what rounding may leave
  Finding acceleration_jump;  // no limit where the jerk has none
  // In the steps, over windows of 10 ms. `limit` is the machine's; rounding to whole steps may add `..._noise`.
  Finding step_velocity;
  Finding step_acceleration;
  double step_velocity_noise = 0;
  double step_acceleration_noise = 0;
};

struct MotionProof {
  std::vector<AxisProof> axes;
  Finding feed;       // ṡ against the programmed speed
  Finding deviation;  // of planned and programmed path from each other; the limit is the tolerance of that place
  Finding gap;        // between the end of one phase and the beginning of the next, mm
  Seconds time{0};
  Seconds time_bound{0};  // no motion along the same path within velocity, acceleration and feed is faster
  std::uint64_t moves = 0;
  std::uint64_t phases = 0;

  double times_bound() const { return time_bound > Seconds(0) ? time / time_bound : 0; }
  // What is beyond its limit, a line each; empty: the motion is good.
  std::vector<std::string> faults() const;
  bool good() const { return faults().empty(); }
};

class MotionProver {
 public:
  explicit MotionProver(const ProofOptions& options);
  ~MotionProver();

  void watch(const PathItem& item);
  void watch(const MotionItem& item);
  void watch(const BoardItem& item);
  // After the last item; once.
  MotionProof finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
