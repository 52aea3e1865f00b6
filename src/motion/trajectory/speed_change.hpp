// SpeedChange: a motion from a speed and an acceleration to another speed without acceleration, on the path and within
// the limits of every axis, jerk included. Private to trajectory/.
//
//   acceleration  __                 up to three phases: to the strongest value, at it, and back to 0.
//                   \        /       For a hold the change leads to speed 0.
//                    \______/
//
// The limits along the path change from place to place. So the strength and jerk of the change are lowered until no
// place asks for too much. Where the motion already uses a limit to the full, no such change is possible: then it goes
// down step by step, in each as far as the places ahead allow. A change may not pass a rest of the path.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "feed_factors.hpp"
#include "jerk_cell.hpp"
#include "path_ahead.hpp"
#include "path_state.hpp"
#include "phase_chain.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

// After a rest amid a segment, at least so much of it is left. `speed`: from which the motion has come to rest.
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
    FeedFactors feeds;     // the change keeps to these feeds
    double exit = 0;       // the wanted speed; at most the speed that remains when the acceleration just goes to 0
    bool planned = false;  // the profile has looked at the change already, also at kinks of limits that fall
  };
  // Plans the change from `state` on. Returns nothing where the limits do not allow one.
  static std::optional<SpeedChange> plan(PathAhead& path, const PathState& state, const Request& request);
  // The same in one way only.
  enum class Way : std::uint8_t { of_one_strength, in_steps };
  static std::optional<SpeedChange> plan(PathAhead& path, const PathState& state, const Request& request, Way way);

  // The change in these pieces, which end at rest there. Returns nothing where they do not keep the limits.
  static std::optional<SpeedChange> to_rest(const std::vector<Piece>& pieces, const PathState& end, PathAhead& path,
                                            const Request& request);

  // How long a stop would take without acceleration at its start, if the path went on straight.
  static Seconds shortest_stop(PathAhead& path, const PathState& state, const std::vector<LimitedAxis>& axes);

  const std::vector<Piece>& pieces() const { return pieces_; }
  // The time of the pieces from that one on.
  Seconds duration_from(std::size_t piece) const;
  // About the way to brake from the speed at its end.
  double braking_way() const { return braking_way_; }
  // Where it ends, without acceleration.
  const PathState& end() const { return end_; }

 private:
  struct Strength {
    double acceleration = 0;
    double jerk = 0;
  };
  static Strength strength_at(const Segment& segment, const PathState& state, const std::vector<LimitedAxis>& axes);
  struct Rooms;    // what the axes leave at a place
  struct Demand {  // as multiples of the limits
    double speed = 0;
    double force = 0;
    double jolt = 0;
  };
  struct Look {  // at one instant
    std::array<Demand, most_limited_axes> axes{};
    std::size_t count = 0;
  };
  struct Excess {
    Demand most;
    void raise(const Look& look);
    void raise_between(const std::array<Look, 3>& looks, std::size_t newest);
  };
  [[nodiscard]] bool shape(const PathState& state, double exit, const Strength& strength);
  // `share`: the strength as shares of the limits.
  [[nodiscard]] bool shape_in_steps(PathAhead& path, const PathState& state, const Request& request,
                                    const Strength& strength, const Strength& share);
  void add(double duration, double jerk);
  enum class Laid : std::uint8_t {
    whole,
    blocked,      // the path ends or rests before the change ends
    near_an_end,  // the change ends so near a segment's end that the rest of the segment is too short to go on in
  };
  Laid lay(PathAhead& path, const PathState& state);
  Demand excess(PathAhead& path, const Request& request) const;
  // `part`: of the time of the whole change.
  static void check_piece(const Piece& piece, double part, const Segment& segment, const Request& request,
                          Excess& worst);
  static Look look_at(const Piece& piece, const Segment& segment, const Request& request, double time);

  std::vector<Phase> phases_;  // starts count from the start of the change
  std::vector<Piece> pieces_;  // the same phases, cut where segments end
  PhaseChain chain_;           // of the phases
  PathState end_;
  double braking_way_ = 0;
};

}  // namespace passo
