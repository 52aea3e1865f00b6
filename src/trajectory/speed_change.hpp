// SpeedChange: from a speed and an acceleration to another speed without acceleration, on the path and within the
// limits of every axis, jerk included. Private to trajectory/.
//
//   acceleration  __                 up to three phases: to the strongest, there, and back to none. For a hold the
//   speed
//                   \        /       it leads to is 0.
//                    \______/
//
// What the axes allow changes along the path: strength and jerk of the change are lowered until no place of it asks
// for too much. A change that passes a rest of the path is none.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "feed_factors.hpp"
#include "jerk_cell.hpp"
#include "path_ahead.hpp"

#include "passo/trajectory/phase.hpp"

namespace passo {

// How the motion goes on from a place of a segment of the path.
struct PathState {
  double s = 0;
  double speed = 0;
  double acceleration = 0;
  std::size_t segment = 0;  // counted from the path's first
};

class SpeedChange {
 public:
  struct Piece {
    std::size_t segment = 0;  // of the path when the change began
    bool ends_segment = false;
    Phase phase;
  };

  struct Request {
    const std::vector<LimitedAxis>& axes;
    FeedFactors feeds;  // on the feeds that are kept to
    double exit = 0;    // speed; above what it would be if the acceleration just went to nothing: that
  };
  // The change from `state` on; nothing where the limits do not allow it.
  static std::optional<SpeedChange> plan(PathAhead& path, const PathState& state, const Request& request);

  const std::vector<Piece>& pieces() const { return pieces_; }
  double exit() const { return exit_; }
  double duration() const { return duration_; }
  // Of the speed it leads to, about.
  double braking_way() const { return braking_way_; }
  // Where it ends.
  std::size_t segment() const { return segment_; }
  double s() const { return s_; }

 private:
  struct Strength {
    double acceleration = 0;
    double jerk = 0;
  };
  struct Demand {  // multiples of the limits
    double speed = 0;
    double force = 0;
    double jolt = 0;
  };
  struct Look {  // at an instant
    std::array<Demand, axis_count> axes{};
    std::size_t count = 0;
  };
  struct Excess {
    Demand most;
    void raise(const Look& look);
    void raise_between(const std::array<Look, 3>& looks, std::size_t newest);
  };
  static Strength strength_at(const Segment& segment, const PathState& state, const std::vector<LimitedAxis>& axes);
  [[nodiscard]] bool shape(const PathState& state, double exit, const Strength& strength);
  void add(double duration, double jerk);
  enum class Laid : std::uint8_t {
    whole,
    blocked,      // the path ends or rests before it does
    near_an_end,  // of a segment, so near that what is left of that is nothing to go on in
  };
  Laid lay(PathAhead& path, const PathState& state);
  Demand excess(PathAhead& path, const Request& request) const;
  static void look_over(const Piece& piece, const Segment& segment, const Request& request, Excess& worst);
  static Look look_at(const Piece& piece, const Segment& segment, const std::vector<LimitedAxis>& axes, double time);

  std::vector<Phase> phases_;  // starts counted from the beginning of the change
  std::vector<Piece> pieces_;  // the same, cut where segments end
  double speed_ = 0;           // while it is shaped
  double acceleration_ = 0;
  double way_ = 0;
  double exit_ = 0;
  double duration_ = 0;
  double braking_way_ = 0;
  std::size_t segment_ = 0;
  double s_ = 0;
};

}  // namespace passo
