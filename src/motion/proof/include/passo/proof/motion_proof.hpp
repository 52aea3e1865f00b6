// MotionProver: observes a job independently, and measures its actual motion.
//
// It verifies the planner and the path smoother, and shares no code with them. It evaluates curves by independent
// formulas, simulates steps from the definition in wire/board_segment.hpp, and compares the time with the shortest
// possible time on the same path. docs/motion-proof.md has every formula.
//
// It is not a stage of the pipeline. Pass it, in their order, the programmed path (Job::path()), the planned motion
// (Job::motion()) and the board items (Job::board()). A motion item must come after the path segments that it executes.
// Memory is bounded: a window of the path, for a job of any length.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The limits of one motor of the board and its axis. 0 means no limit.
struct ProvenAxis {
  Axis axis = Axis::x;
  Mm step{0};  // the length of one step; 0: steps are not checked
  MmPerSecond velocity{0};
  MmPerSecond2 acceleration{0};
  MmPerSecond3 jerk{0};
  // At a stop point, the velocity may jump between two values, of which neither exceeds this and which differ by at
  // most this. 0: no jump.
  MmPerSecond start_stop = MmPerSecond(0);
  // Travel of the motor at a reversal before the axis moves. The motor must take it up while the tool is stopped.
  Mm backlash{0};
  // A limit that falls with the speed: monotonically falling, and above 0 up to `velocity`. Empty: `acceleration` at
  // all speeds.
  std::function<MmPerSecond2(MmPerSecond)> acceleration_at = {};
  // The radius of the cylinder that this axis turns: the feed counts its surface. 0: the radius of each segment.
  std::optional<Mm> surface_radius = {};
};
struct ProofOptions {
  std::vector<ProvenAxis> axes;  // in the order of the board's motors
  Hertz tick_rate{16e6};
};

// The worst value of a quantity: the largest value, or, if the limit changes with the speed, the largest multiple of
// the limit. Units: mm (or degrees) and seconds.
struct Finding {
  double value = 0;
  double limit = 0;        // 0: no limit
  Seconds time{0};         // since the start of the motion
  std::uint32_t line = 0;  // of the program; 0: unknown

  double multiple() const { return limit > 0 ? value / limit : 0; }
};

struct AxisProof {
  Axis axis = Axis::x;
  // Within phases.
  Finding velocity;
  Finding acceleration;
  Finding jerk;
  // Between two phases.
  Finding velocity_jump;      // the limit is the rounding tolerance, or the start-stop velocity at a stop point
  Finding acceleration_jump;  // no limit where the jerk has no limit
  // How far the tool is behind the plan because backlash was not taken up. The limit is a step.
  Finding lost_motion;
  // Measured from the steps, over windows of 10 ms. `limit` is the machine's; rounding to whole steps may add
  // `..._noise`. Permitted jumps at stop points do not count as acceleration.
  Finding step_velocity;
  Finding step_acceleration;
  double step_velocity_noise = 0;
  double step_acceleration_noise = 0;
};

struct MotionProof {
  std::vector<AxisProof> axes;
  Finding feed;       // the speed along the path, or of the surface of a cylinder, against the programmed one
  Finding deviation;  // between planned and programmed path; the limit is the tolerance at that point
  Finding gap;        // between the end of one phase and the start of the next, mm
  Seconds time{0};
  Seconds time_bound{0};  // no motion on the same path within velocity, acceleration, jerk and feed limits takes less
  // No motion on any path within the tolerance takes less, within the same limits. 0 without a programmed path. Axes
  // with a start-stop velocity count as having no acceleration limit.
  Seconds tube_bound{0};
  std::uint64_t moves = 0;
  std::uint64_t phases = 0;

  double times_tube_bound() const { return tube_bound > Seconds(0) ? time / tube_bound : 0; }
  double times_bound() const { return time_bound > Seconds(0) ? time / time_bound : 0; }
  // The exceeded limits, one line each. Empty: the motion is good.
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
  // Call once, after the last item.
  MotionProof finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
