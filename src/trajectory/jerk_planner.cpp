#include "jerk_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rest.hpp"

namespace passo {
namespace {

constexpr std::size_t first_window = 200;
constexpr std::size_t phases_a_cell = 2;

}  // namespace

JerkPlanner::JerkPlanner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
    : path_(path),
      axes_(axes_with_limits(limits)),
      cutter_(axes_),
      profile_(axes_),
      most_queued_(std::max<std::size_t>(most_queued, 2 * first_window)),
      shapes_(axes_.size()) {}

bool JerkPlanner::next(MotionItem& item) {
  while (given_ == decided_ && !(profile_.size() == given_ && closed_)) look_ahead();
  if (given_ < decided_) {
    give_move(item);
    return true;
  }
  if (!action_) return false;
  item = *std::exchange(action_, std::nullopt);
  profile_.drop(given_);
  given_ = decided_ = 0;
  closed_ = path_ended_ = false;
  begins_at_rest_ = true;
  return true;
}

void JerkPlanner::look_ahead() {
  profile_.drop(given_);
  given_ = decided_ = 0;
  const std::size_t wanted =
      std::max<std::size_t>(profile_.fell_back() ? profile_.size() : 2 * profile_.size(), first_window);
  while (!closed_ && profile_.size() < wanted && profile_.size() < most_queued_) pull();
  if (profile_.size() == 0) return;
  decided_ = profile_.plan(closed_);
  if (!closed_ && profile_.size() >= most_queued_) decided_ = std::max(decided_, profile_.planned() / 2);
}

// One more segment of the path; false where there is none before the action or the end.
bool JerkPlanner::fetch() {
  while (!path_ended_) {
    if (!path_.next(pulled_)) {
      path_ended_ = true;
    } else if (const auto* action = std::get_if<Action>(&pulled_)) {
      action_ = *action;
      path_ended_ = true;
    } else if (auto& segment = std::get<Segment>(pulled_); segment.curve.has_length()) {
      segments_.push_back(segment);
      return true;
    }
  }
  return false;
}

// One more cell. A segment is cut when the one after it is known.
void JerkPlanner::pull() {
  if (cutting_ && cutter_.next(cell_, shapes_.data())) {
    profile_.push(cell_, shapes_.data(), begins_at_rest_);
    begins_at_rest_ = false;
    estimate_ =
        std::min(std::min(estimate_, profile_.last_cap()) + 2 * cell_.acceleration * cell_.length, cell_.top_squared);
    return;
  }
  if (cutting_) {
    cutting_ = false;
    ++cut_;
  }
  while (segments_.size() < cut_ + 2 && fetch()) {
  }
  if (segments_.size() == cut_) {
    closed_ = true;
    return;
  }
  const Segment& segment = segments_[cut_];
  begins_at_rest_ = cut_ == 0 || rests_between(segments_[cut_ - 1], segment);
  const bool ends_at_rest = segments_.size() == cut_ + 1 || rests_between(segment, segments_[cut_ + 1]);
  const double exit = ends_at_rest ? 0 : cutter_.joint_cap(segment, segments_[cut_ + 1]);
  estimate_ = begins_at_rest_ ? 0 : std::min(estimate_, cutter_.joint_cap(segments_[cut_ - 1], segment));
  cutter_.begin(segment, estimate_, exit);
  cutting_ = true;
}

void JerkPlanner::give_move(MotionItem& item) {
  auto* move = std::get_if<PlannedMove>(&item);
  if (move == nullptr) move = &item.emplace<PlannedMove>();
  move->segment = segments_.front();
  move->phase_count = 0;
  bool ended = false;
  while (given_ < decided_ && !ended && move->phase_count + phases_a_cell <= PlannedMove::most_phases) {
    profile_.add_phases(given_, *move);
    const JerkCell& cell = profile_.cell(given_);
    ended = cell.ends_segment;
    move->to = Mm(ended ? move->segment.curve.length().value() : cell.start + cell.length);
    ++given_;
  }
  if (ended) {
    segments_.pop_front();
    --cut_;
  }
}

}  // namespace passo
