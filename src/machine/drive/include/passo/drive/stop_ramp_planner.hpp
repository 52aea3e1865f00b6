// StopRampPlanner: computes the stop ramp (tail) of a queue update: the motion that stops the machine on the path after
// the planned motion. The planner computes the deceleration, and a fork of the step generator converts it into items.
// The planner and the generator themselves remain unchanged.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "passo/drive/feed_stages.hpp"
#include "passo/drive/played_motion.hpp"
#include "passo/drive/stop_ramp_options.hpp"

namespace passo {

// A stop point on the path, with the state of the generator and the outputs there.
struct StopOnPath {
  PathPosition place = {};
  std::unique_ptr<StepGenerator> generator = {};
  CommandedOutputs outputs = {};
};

// The stop ramp. If the motion already ends in a stop, the stop ramp has no items.
struct StopRamp {
  PathPosition from = {};
  StopOnPath rest = {};
  std::vector<LinkItem> items = {};
  // Its motion, for observers of the executed motion: it follows this number of items of the path's motion.
  std::uint64_t motion_from = 0;
  std::vector<PlannedMove> motion = {};
};

class StopRampPlanner {
 public:
  // All stages and `played` must outlive the maker. `places`: the board's queue places.
  StopRampPlanner(const FeedStages& stages, const StepOptions& steps, const StopRampOptions& options,
                  std::size_t places, const PlayedMotion& played);

  // Computes the stop ramp from `given`, the end of the planned motion. `in_few_items`: prefer few items to exact ones.
  StopRamp brake(const PathPosition& given, bool in_few_items);
  // Returns an empty stop ramp, for a machine that is already stopped there.
  StopRamp at_rest(const PathPosition& given);

 private:
  void add_item(StopRamp& tail) const;

  FeedStages stages_;
  StepOptions steps_;
  StopRampOptions options_;
  Planner::Braking braking_;
  const PlayedMotion& played_;
  BoardItem item_;
  std::vector<PlannedMove> plan_;
};

}  // namespace passo
