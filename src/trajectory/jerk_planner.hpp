// JerkPlanner: what Planner does where an axis has a limit of jerk: the acceleration changes continuously, and goes on
// through joints of segments. Private to trajectory/.
#pragma once

#include <deque>
#include <optional>

#include "jerk_profile.hpp"

#include "passo/base/source.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class JerkPlanner final : public Source<MotionItem> {
 public:
  JerkPlanner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued);

  [[nodiscard]] bool next(MotionItem& item) override;
  // At rest: what is left of the path up to the next action is dropped.
  void drop_to_action();

 private:
  bool fetch();
  void pull();
  void look_ahead();
  void give_move(MotionItem& item);

  Source<PathItem>& path_;
  std::vector<LimitedAxis> axes_;
  JerkCutter cutter_;
  JerkProfile profile_;
  std::size_t most_queued_;

  std::deque<Segment> segments_;  // whose cells are in the profile, or are being cut, and then the one that follows
  std::size_t cut_ = 0;           // of them
  bool cutting_ = false;
  bool begins_at_rest_ = true;  // the next cell
  double estimate_ = 0;         // squared: how fast the next cell may be entered
  bool path_ended_ = false;     // no more segments before the action or the end
  bool closed_ = false;
  std::size_t decided_ = 0;  // cells at the front that nothing to come can change
  std::size_t given_ = 0;    // of them
  std::optional<Action> action_;
  PathItem pulled_;
  JerkCell cell_;
  std::vector<AxisShape> shapes_;
};

}  // namespace passo
