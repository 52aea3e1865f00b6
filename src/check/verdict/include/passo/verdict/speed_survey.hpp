// SpeedSurvey: watches planned motion, and says what bounds its speed: the programmed feed, or a limit of an axis.
//
// A planned motion is as fast as it can be, so at nearly every moment some limit is reached. The survey looks at each
// phase in one to three places, compares speed, acceleration and jerk of the axes with their limits, and takes the
// limit of which the greatest share is used.
//
// A part of the program is the motion of one line. A line that is played again, as in a loop, is a new part. The
// slowest parts are the lines at feed that lose the most time against their programmed feed; the fastest ones have the
// highest speed. Where a line takes up backlash, the tool stands: that time is lost, and the line stays one part.
// Memory is bounded, whatever the program.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

// What bounds the speed at a moment. Each but `feed` and `passage` is a limit of an axis.
struct SpeedBound {
  enum class Kind : std::uint8_t {
    feed,          // the programmed speed
    velocity,      // of the axis
    acceleration,  // the constant limit, along the path
    bending,       // the same limit, where most of it turns the path
    torque,        // the acceleration that the motor has left at this speed
    jerk,
    passage,  // no limit is reached: the motion passes from one to the next
  };
  Kind kind = Kind::passage;
  Axis axis = Axis::x;  // of a limit of an axis
  friend bool operator==(const SpeedBound&, const SpeedBound&) = default;
};

// A bound with the time that the motion spends at it.
struct SpeedShare {
  SpeedBound bound;
  Seconds time{0};
  std::uint32_t first_line = 0;  // where the program reaches it first
  double limit = 0;              // constant, of the axis: mm/s, mm/s² or mm/s³ (degrees for a rotary axis); else 0
};

// The motion of one line of the program.
struct SpeedPart {
  std::uint32_t line = 0;
  bool rapid = false;
  bool turns = false;  // A, B or C alone: the way is in degrees, the speeds in degrees/s
  Mm way{0};
  Seconds time{0};
  Seconds lost{0};            // against the programmed feed; 0 for a rapid
  MmPerSecond programmed{0};  // the highest in it; infinite for a rapid
  MmPerSecond highest{0};
  SpeedBound bound = {};  // where the most time is lost; for a rapid and in `fastest`: at the highest speed

  MmPerSecond mean() const { return time > Seconds(0) ? way / time : MmPerSecond(0); }
};

struct SpeedReport {
  std::vector<SpeedShare> shares;  // the most time first; only bounds that were reached
  std::vector<SpeedPart> slowest;  // the most time lost first
  std::vector<SpeedPart> fastest;  // feeds, the fastest first, then the fastest rapid
};

class SpeedSurvey {
 public:
  static constexpr std::size_t most_parts = 5;

  // `axes`: those of the machine.
  SpeedSurvey(MotionLimits limits, AxisSet axes);

  void watch(const PlannedMove& move);
  // Call after the last move.
  SpeedReport report();

 private:
  static constexpr std::size_t kinds = 7;
  struct Reached {
    Seconds time{0};
    Seconds lost{0};  // in the part at hand
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
  std::vector<std::size_t> touched_;  // entries of reached_ that have `lost` in the part at hand
  SpeedPart part_;
  bool in_part_ = false;
  bool only_takes_up_ = false;  // the part has had no motion yet but that which takes up backlash
  SpeedBound at_highest_;
  MmPerSecond highest_look_{0};
  std::vector<SpeedPart> slowest_;
  std::vector<SpeedPart> fastest_;
  SpeedPart fastest_rapid_;
};

// "the programmed feed", "the velocity of X".
std::string describe(const SpeedBound& bound);

}  // namespace passo
