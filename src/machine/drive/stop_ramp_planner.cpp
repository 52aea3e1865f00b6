#include "passo/drive/stop_ramp_planner.hpp"

#include <utility>

namespace passo {
namespace {

// Hands out the planner's braking plan as motion.
class Braking final : public Source<MotionItem> {
 public:
  explicit Braking(const std::vector<PlannedMove>& plan) : plan_(plan) {}
  [[nodiscard]] bool next(MotionItem& item) override {
    if (given_ == plan_.size()) return false;
    item = plan_[given_++];
    return true;
  }

 private:
  const std::vector<PlannedMove>& plan_;
  std::size_t given_ = 0;
};

}  // namespace

StopRampPlanner::StopRampPlanner(const FeedStages& stages, const StepOptions& steps, const StopRampOptions& options,
                                 std::size_t places, const PlayedMotion& played)
    : stages_(stages),
      steps_(steps),
      options_(options),
      braking_(places >= options.places_for_gentle_tails ? Planner::Braking::gentle : Planner::Braking::hard),
      played_(played) {}

StopRamp StopRampPlanner::brake(const PathPosition& given, bool in_few_items) {
  stages_.planner.braking_plan(plan_, braking_);
  StopRamp tail{.from = given, .rest = {.place = given, .outputs = stages_.outputs}};
  for (const PlannedMove& move : plan_) tail.rest.place = stages_.path.behind(tail.rest.place, move);
  tail.motion_from = played_.given();
  if (played_.is_watched()) tail.motion = plan_;
  Braking braking(plan_);
  StepGenerator& rested = *(tail.rest.generator = std::make_unique<StepGenerator>(braking, steps_));
  rested.assume(stages_.generator);
  rested.be_exact_to(in_few_items ? options_.tail_in_few_places : options_.tail);
  while (rested.next(item_)) add_item(tail);
  if (tail.rest.outputs.halt()) tail.items.emplace_back(tail.rest.outputs.tell());
  return tail;
}

// The outputs change along the stop ramp as on the rest of the path, so that the path has no gap where it goes on.
void StopRampPlanner::add_item(StopRamp& tail) const {
  if (const auto* outputs = std::get_if<PathOutputs>(&item_)) {
    tail.rest.outputs.apply(*outputs);
    tail.items.emplace_back(tail.rest.outputs.tell());
  } else {
    tail.items.emplace_back(std::get<BoardSegment>(item_));
  }
}

// The copy of the generator has no motion to read.
StopRamp StopRampPlanner::at_rest(const PathPosition& given) {
  plan_.clear();
  Braking nothing(plan_);
  auto fork = std::make_unique<StepGenerator>(nothing, steps_);
  fork->assume(stages_.generator);
  return {.from = given,
          .rest = {.place = given, .generator = std::move(fork), .outputs = stages_.outputs},
          .items = {},
          .motion_from = played_.given()};
}

}  // namespace passo
