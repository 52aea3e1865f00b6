// SpeedSurvey: observes planned motion and determines what limits its speed: the programmed feed, or a limit of an
// axis.
//
// A planned motion is as fast as possible, so at nearly every moment some limit is reached. The survey evaluates each
// phase at one to three points, compares speed, acceleration and jerk of the axes with their limits, and selects the
// limit with the highest utilisation.
//
// A part of the program is the motion of one line. A line that is executed again, as in a loop, is a new part. The
// slowest parts are the feed lines that lose the most time against their programmed feed; the fastest ones have the
// highest speed. While backlash is taken up, the tool is stopped: that time counts as lost, and the line remains one
// part. Memory is bounded, whatever the program.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// What limits the speed at a moment. All except `feed` and `passage` are limits of an axis.
struct SpeedBound {
  enum class Kind : std::uint8_t {
    feed,          // the programmed feed
    velocity,      // velocity limit of the axis
    acceleration,  // the constant limit, mainly along the path
    bending,       // the same limit, mainly for the centripetal acceleration
    torque,        // the acceleration that the motor's torque allows at this speed
    jerk,
    passage,  // no limit is reached: a transition between two limits
  };
  Kind kind = Kind::passage;
  Axis axis = Axis::x;  // the axis, if it is a limit of an axis
  friend bool operator==(const SpeedBound&, const SpeedBound&) = default;
};

// A limit, and the time during which it determines the speed.
struct SpeedShare {
  SpeedBound bound;
  Seconds time{0};
  std::uint32_t first_line = 0;  // line of its first occurrence
  double limit = 0;              // for a constant limit of an axis: mm/s, mm/s² or mm/s³ (degrees for a rotary axis);
                                 // else 0
};

// The motion of one line of the program.
struct SpeedPart {
  std::uint32_t line = 0;
  bool rapid = false;
  bool turns = false;  // A, B or C only: length in degrees, speeds in degrees/s
  Mm way{0};
  Seconds time{0};
  Seconds lost{0};            // compared with the programmed feed; 0 for a rapid
  MmPerSecond programmed{0};  // maximum in this part; infinite for a rapid
  MmPerSecond highest{0};
  SpeedBound bound = {};  // where the most time is lost; for a rapid and in `fastest`: at the maximum speed

  MmPerSecond mean() const { return time > Seconds(0) ? way / time : MmPerSecond(0); }
  // A smaller loss of time is not reported.
  static constexpr Seconds notable_loss{0.005};
  bool is_slow() const { return lost >= notable_loss; }
};

struct SpeedReport {
  std::vector<SpeedShare> shares;  // sorted by time, the longest first; only limits that were reached
  std::vector<SpeedPart> slowest;  // sorted by lost time, the most first
  std::vector<SpeedPart> fastest;  // feed moves, the fastest first, then the fastest rapid
};

class SpeedSurvey {
 public:
  static constexpr std::size_t most_parts = 5;

  // `axes`: the axes of the machine.
  SpeedSurvey(MotionLimits limits, AxisSet axes);

  void watch(const PlannedMove& move);
  // Must be called after the last move.
  SpeedReport report();

 private:
  static constexpr std::size_t kinds = 7;
  struct Reached {
    Seconds time{0};
    Seconds lost{0};  // time lost in the current part
    std::uint32_t first_line = 0;
    double limit = 0;
  };
  struct Found {
    SpeedBound bound;
    double limit = 0;
  };

  Found bound_at(const PlannedMove& move, const Phase& phase, Seconds t) const;
  void watch_phase(const PlannedMove& move, const Phase& phase, double curvature);
  Reached& reached(const SpeedBound& bound);
  void end_part();

  MotionLimits limits_;
  std::vector<Axis> axes_;
  std::array<Reached, kinds * axis_count> reached_{};
  std::vector<std::size_t> touched_;  // entries of reached_ that have `lost` in the current part
  SpeedPart part_;
  bool in_part_ = false;
  bool only_takes_up_ = false;  // so far the current part has only taken up backlash
  SpeedBound at_highest_;
  MmPerSecond highest_look_{0};
  std::vector<SpeedPart> slowest_;
  std::vector<SpeedPart> fastest_;
  SpeedPart fastest_rapid_;
};

// Returns e.g. "the programmed feed", "the velocity of X".
std::string describe(const SpeedBound& bound);

}  // namespace passo
