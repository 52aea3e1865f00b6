// SpeedChange: a motion from a speed and an acceleration to another speed without acceleration, on the path and within
// the limits of every axis, including jerk. Private to trajectory/.
//
//   acceleration  __                 up to three phases: to the strongest value, constant, and back to 0.
//                   \        /       For a hold the change leads to speed 0.
//                    \______/
//
// The limits along the path vary. So the strength and jerk of the change are reduced until no point exceeds a limit.
// Where the motion already uses a limit fully, no such change is possible: then the speed is reduced in steps, each as
// large as the points ahead allow. A change must not pass a stop of the path.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "feed_factors.hpp"
#include "jerk_cell.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"
#include "phase_chain.hpp"
#include "rest.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

// Returns the minimum length that must remain after a stop inside a segment. `speed`: the speed before the stop.
double least_rest(const Curve& curve, double speed);

class SpeedChange {
 public:
  struct Piece {
    std::uint64_t segment = 0;
    bool ends_segment = false;
    Phase phase;
  };

  struct Request {
    const std::vector<LimitedAxis>& axes;
    FeedFactors feeds;     // the change stays within these feeds
    double exit = 0;       // the requested speed, or the speed that remains when the acceleration has returned to 0, if
                           // that is lower
    bool planned = false;  // the profile has already checked the change, including kinks of falling limits
    // For a change to rest: the motors stop at once from the speeds that these allow. Null: from 0 only.
    const StopSpeeds* stops = nullptr;
  };
  // Plans the change from `state` on. Returns nothing if the limits do not allow one.
  static std::optional<SpeedChange> plan(PathAhead& path, const PathState& state, const Request& request);
  // The same with only one method.
  enum class Way : std::uint8_t { of_one_strength, in_steps };
  static std::optional<SpeedChange> plan(PathAhead& path, const PathState& state, const Request& request, Way way);

  // Returns the change in these pieces, which end in a stop. Returns nothing if they exceed the limits.
  static std::optional<SpeedChange> to_rest(const std::vector<Piece>& pieces, const PathState& end, PathAhead& path,
                                            const Request& request);

  // Returns how long a stop would take if the path continued straight.
  static Seconds shortest_stop(PathAhead& path, const PathState& state, const Request& request);

  const std::vector<Piece>& pieces() const { return pieces_; }
  // Returns the total time of the pieces from that one on.
  Seconds duration_from(std::size_t piece) const;
  // Returns the approximate braking distance from the speed at its end.
  double braking_way() const { return braking_way_; }
  // Returns the state at its end, without acceleration. A change to rest ends with speed 0, even if its last phase does
  // not.
  const PathState& end() const { return end_; }

 private:
  struct Strength {
    double acceleration = 0;
    double jerk = 0;
  };
  static Strength strength_at(const Segment& segment, const PathState& state, const std::vector<LimitedAxis>& axes);
  static double stop_speed(PathAhead& path, const PathState& at, const Request& request);
  struct Rooms;    // remaining limits of the axes at a point
  struct Demand {  // as multiples of the limits
    double speed = 0;
    double force = 0;
    double jolt = 0;
  };
  struct Look {  // evaluated at one instant
    std::array<Demand, most_limited_axes> axes{};
    std::size_t count = 0;
  };
  struct Excess {
    Demand most;
    void raise(const Look& look);
    void raise_between(const std::array<Look, 3>& looks, std::size_t newest);
  };
  [[nodiscard]] bool shape(const PathState& state, double exit, double least, const Strength& strength);
  // `share`: the strength as fractions of the limits.
  [[nodiscard]] bool shape_in_steps(PathAhead& path, const PathState& state, const Request& request,
                                    const Strength& strength, const Strength& share);
  void add(double duration, double jerk);
  enum class Laid : std::uint8_t {
    whole,
    blocked,      // the path ends or stops before the change ends
    near_an_end,  // the change ends so near a segment's end that the remainder is too short to continue in
  };
  Laid lay(PathAhead& path, const PathState& state);
  Demand excess(PathAhead& path, const Request& request) const;
  // `part`: fraction of the time of the whole change.
  static void check_piece(const Piece& piece, double part, const Segment& segment, const Request& request,
                          Excess& worst);
  static Look look_at(const Piece& piece, const Segment& segment, const Request& request, double time);

  std::vector<Phase> phases_;  // their starts count from the start of the change
  std::vector<Piece> pieces_;  // the same phases, divided at segment ends
  PhaseChain chain_;           // chain of the phases
  PathState end_;
  double braking_way_ = 0;
};

}  // namespace passo
