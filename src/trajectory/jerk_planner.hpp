// JerkPlanner: does Planner's work where an axis has a limit of jerk. The acceleration changes continuously, also
// through joints of segments. Private to trajectory/.
//
// A change in mid-run leads off the plan (JerkWindow) by a SpeedChange. For a hold the change leads to rest, else to a
// speed from which a new plan goes on. The old plan stays until both are found. At rest everything may change.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "feed_factors.hpp"
#include "jerk_window.hpp"
#include "path_ahead.hpp"
#include "speed_change.hpp"

#include "passo/base/source.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class JerkPlanner final : public Source<MotionItem> {
 public:
  JerkPlanner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued);

  [[nodiscard]] bool next(MotionItem& item) override;
  // As in Planner.
  void braking_plan(std::vector<PlannedMove>& plan);
  // At rest: drops the rest of the path up to the next action.
  void drop_to_action();

  // As in Planner.
  void limit_moves_to(Seconds duration) { longest_move_ = duration; }
  void wish(const MidRunWishes& wishes);

 private:
  struct Outlook;
  bool look_ahead(Outlook& outlook, PlannedMove& move);
  static bool take_pieces(const SpeedChange& change, std::size_t& given, PlannedMove& move);
  static PathState behind(const PlannedMove& move);
  bool stands();
  void adapt(bool stands);
  void stop_sooner();
  bool go_over();
  bool produce(PlannedMove& move);
  void append(const PlannedMove& move, std::vector<PlannedMove>& plan) const;
  static std::optional<PlannedMove> shorten(PlannedMove& move, Seconds longest);
  void take_note(const PlannedMove& move);

  std::vector<LimitedAxis> axes_;
  PathAhead path_;
  std::size_t most_queued_;
  std::unique_ptr<JerkWindow> window_;

  PathState now_;  // at the end of the last move given
  OutputState outputs_;
  std::optional<PlannedMove> rest_;    // the rest of a move that was too long
  std::optional<SpeedChange> change_;  // leads to the window's start
  std::size_t given_pieces_ = 0;       // pieces of the change
  std::size_t passed_segments_ = 0;    // segments passed since the change began

  Seconds longest_move_{std::numeric_limits<double>::infinity()};
  MidRunWishes wishes_;
  FeedFactors fastest_;    // the fastest feeds with which any of the present plan was made
  bool unsuited_ = false;  // the plan does not suit the wishes
};

}  // namespace passo
