#include "passo/trajectory/planner.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "speed_profile.hpp"

#include "passo/trajectory/segment_limits.hpp"

namespace passo {
namespace {

// Speeds are kept squared: that is what grows and falls in proportion to the way.
struct Queued {
  Segment segment;
  double length = 0;
  double acceleration = 0;
  double top_squared = 0;
  double entry_cap = 0;      // squared: by the junction before it and the tops on both sides
  double entry_if_rest = 0;  // how fast it may be entered if the path came to rest behind the queue
  double entry_if_open = 0;  // the same if the path went straight on there for ever

  // How far apart the squares of the speeds at its two ends may be.
  double reach() const { return 2 * acceleration * length; }
};

}  // namespace

class Planner::Implementation {
 public:
  Implementation(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
      : path_(path), limits_(limits), most_queued_(std::max<std::size_t>(most_queued, 2)) {}

  bool next(MotionItem& item) {
    while (decided_ == 0 && !(queue_.empty() && closed_)) look_ahead();
    if (!queue_.empty()) {
      give_move(item);
      return true;
    }
    if (!action_) return false;
    item = *std::exchange(action_, std::nullopt);
    closed_ = false;
    return true;
  }

 private:
  // Each pass over the queue is paid for by as many new segments as it found undecided, which makes planning
  // amortised linear.
  void look_ahead() {
    const std::size_t wanted = std::clamp<std::size_t>(2 * queue_.size(), first_window, most_queued_);
    while (!closed_ && queue_.size() < wanted) pull();
    plan_backwards();
    decide_forwards();
  }

  void pull() {
    if (!path_.next(pulled_)) {
      closed_ = true;
    } else if (const auto* action = std::get_if<Action>(&pulled_)) {
      action_ = *action;
      closed_ = true;
    } else if (const auto& segment = std::get<Segment>(pulled_); segment.curve.has_length()) {
      append(segment);
    }
  }

  void append(const Segment& segment) {
    const SegmentLimits own = segment_limits(segment, limits_);
    const double top = own.speed.value() * own.speed.value();
    double cap = 0;
    bool straight = false;
    if (!queue_.empty()) {
      const Segment& before = queue_.back().segment;
      const Junction junction = junction_between(before, segment, straight_, limits_);
      cap = std::min({junction.speed.value() * junction.speed.value(), top, queue_.back().top_squared});
      straight = junction.straight;
    }
    straight_ = straight ? straight_ + segment.curve.length() : segment.curve.length();
    queue_.push_back({.segment = segment,
                      .length = segment.curve.length().value(),
                      .acceleration = own.acceleration.value(),
                      .top_squared = top,
                      .entry_cap = cap});
  }

  // What is behind the queue lies between a stop at once and nothing that slows it. Both are carried back; from where
  // a cap makes them equal they stay equal, and whatever comes later changes nothing before.
  void plan_backwards() {
    double if_rest = 0;
    double if_open = closed_ || queue_.empty() ? 0 : queue_.back().top_squared;
    for (auto queued = queue_.rbegin(); queued != queue_.rend(); ++queued) {
      if_rest = queued->entry_if_rest = std::min(queued->entry_cap, if_rest + queued->reach());
      if_open = queued->entry_if_open = std::min(queued->entry_cap, if_open + queued->reach());
    }
  }

  // A segment's exit is decided where both agree, or where accelerating from rest does not even reach the lower one.
  void decide_forwards() {
    double entry = speed_squared_;
    for (decided_ = 0; decided_ < queue_.size(); ++decided_) {
      const double reached = entry + queue_[decided_].reach();
      const bool last = decided_ + 1 == queue_.size();
      const double if_rest = last ? 0 : queue_[decided_ + 1].entry_if_rest;
      const double if_open = last ? (closed_ ? 0 : queue_[decided_].top_squared) : queue_[decided_ + 1].entry_if_open;
      if (if_rest != if_open && reached > if_rest) break;
      entry = std::min(reached, if_rest);
    }
    // A queue that is full and holds hardly more than the braking distance is played to its middle as if the path came
    // to rest at its end: slower, and safe, and still linear.
    if (queue_.size() >= most_queued_) decided_ = std::max(decided_, queue_.size() / 2);
  }

  void give_move(MotionItem& item) {
    const Queued& head = queue_.front();
    const double exit_limit = queue_.size() > 1 ? queue_[1].entry_if_rest : 0;
    const double exit = std::min(exit_limit, speed_squared_ + head.reach());

    auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) move = &item.emplace<PlannedMove>();
    move->segment = head.segment;
    add_phases({.length = head.length,
                .acceleration = head.acceleration,
                .top_squared = head.top_squared,
                .entry_squared = speed_squared_,
                .exit_squared = exit},
               *move);
    speed_squared_ = exit;
    queue_.pop_front();
    --decided_;
  }

  static constexpr std::size_t first_window = 64;

  Source<PathItem>& path_;
  const MotionLimits limits_;
  const std::size_t most_queued_;

  std::deque<Queued> queue_;
  std::size_t decided_ = 0;   // segments at its head whose exit speed nothing to come can change
  Mm straight_{0};            // the way at its end that leads in one direction
  double speed_squared_ = 0;  // at the head's start
  bool closed_ = false;       // an action or the program's end follows the queue: it ends at rest
  std::optional<Action> action_;
  PathItem pulled_;
};

Planner::Planner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
    : implementation_(std::make_unique<Implementation>(path, limits, most_queued)) {}
Planner::~Planner() = default;

bool Planner::next(MotionItem& item) {
  return implementation_->next(item);
}

}  // namespace passo
