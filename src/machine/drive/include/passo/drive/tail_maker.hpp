// TailMaker: finds the stop ramp (tail) of a queue update: the motion that stops the machine on the path after the
// planned motion. The planner tells how it would brake, and a fork of the step generator makes that into items. Planner
// and generator then go on as if nothing had been asked.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "passo/drive/feed_stages.hpp"
#include "passo/drive/played_motion.hpp"
#include "passo/drive/tail_options.hpp"

namespace passo {

// A stop point on the path, with the state of the generator and the outputs there.
struct RestOnPath {
  PathPlace place = {};
  std::unique_ptr<StepGenerator> generator = {};
  OutputsOrder outputs = {};
};

// How the machine would come to rest. If the motion ends in a stop, the stop ramp has no items.
struct BrakingTail {
  PathPlace from = {};
  RestOnPath rest = {};
  std::vector<LinkItem> items = {};
  // Its motion, for observers of the executed motion: it follows this number of items of the path's motion.
  std::uint64_t motion_from = 0;
  std::vector<PlannedMove> motion = {};
};

class TailMaker {
 public:
  // All stages outlive the maker, and so does `played`. `places`: of the board, for items.
  TailMaker(const FeedStages& stages, const StepOptions& steps, const TailOptions& options, std::size_t places,
            const PlayedMotion& played);

  // From `given`, which is as far as the planner has given motion. `in_few_items`: these are better than exact ones.
  BrakingTail brake(const PathPlace& given, bool in_few_items);
  // The machine rests there already.
  BrakingTail at_rest(const PathPlace& given);

 private:
  FeedStages stages_;
  StepOptions steps_;
  TailOptions options_;
  Planner::Braking braking_;
  const PlayedMotion& played_;
  BoardItem item_;
  std::vector<PlannedMove> plan_;
};

}  // namespace passo
