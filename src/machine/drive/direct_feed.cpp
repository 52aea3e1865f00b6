#include "passo/drive/direct_feed.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "host_actions.hpp"

namespace passo {
namespace {

// For motion that need not react soon.
constexpr Seconds longest_wait{1000};

// In a probe move, the tool goes on into what it touched for as long as the horizon before it brakes.
constexpr Commitment probing{.horizon = Seconds(0.004), .longest_move = Seconds(0.001)};

// How far ahead to commit while motion follows a spindle.
constexpr double moves_a_horizon = 5;
Seconds horizon_of(SpindleLock lock) {
  switch (lock) {
    case SpindleLock::place: return Seconds(0.01);
    case SpindleLock::speed: return Seconds(0.05);
    case SpindleLock::none: break;
  }
  return Seconds(std::numeric_limits<double>::infinity());
}

Commitment with_horizon(const Commitment& live, SpindleLock lock) {
  const Seconds horizon = horizon_of(lock);
  return {.horizon = std::min(live.horizon, horizon),
          .longest_move = std::min(live.longest_move, horizon / moves_a_horizon)};
}

Seconds time_of(const MotionItem& item) {
  const auto* action = std::get_if<Action>(&item);
  return action != nullptr ? action->dwell : std::get<PlannedMove>(item).duration();
}

}  // namespace

DirectFeed::DirectFeed(const Stages& stages, const Options& options)
    : stages_(stages),
      options_(options),
      live_(options.live),
      ahead_(endless_commitment),
      given_(stages.path.place()),
      rested_(stages.link.now()) {
  apply(live_);
}

// The commitment for motion that does not follow a spindle.
Commitment DirectFeed::commitment() const {
  return attention_ == Attention::probes ? probing : live_;
}

void DirectFeed::apply(const Commitment& wanted) {
  if (wanted == ahead_) return;
  ahead_ = wanted;
  stages_.planner.limit_moves_to(wanted.longest_move);
  stages_.generator.limit_waiting_to(std::min(wanted.longest_move, longest_wait));
}

// watch() sets the commitment for motion that follows the spindle.
void DirectFeed::attend(Attention attention) {
  attention_ = attention;
  if (attention == Attention::follows) return;
  apply(commitment());
}

void DirectFeed::expect_thread() {
  live_ = with_horizon(live_, SpindleLock::speed);
  if (ahead_.horizon > live_.horizon) apply(live_);
}

void DirectFeed::watch(const MotionItem& motion) {
  planned_ += time_of(motion);
  if (options_.reads_again) {
    given_ = stages_.path.behind(given_, motion);
    stages_.path.forget_before(given_.item);
  }
  if (!options_.follows_spindle) return;
  // Committed motion cannot react to the spindle, so little is committed.
  if (const auto* move = std::get_if<PlannedMove>(&motion)) {
    apply(with_horizon(commitment(), move->segment.lock));
  } else if (std::get<Action>(motion).kind == Action::Kind::await_index) {
    apply(with_horizon(commitment(), SpindleLock::place));
  }
}

Feed::Progress DirectFeed::advance() {
  if (stages_.link.error()) return Progress::ended;
  if (!send_waiting()) return Progress::waits;
  if (action_ || ended_) {
    if (stages_.link.busy()) return Progress::waits;
    if (!action_) return Progress::ended;
    if (action_->kind != Action::Kind::feed_hold) return Progress::at_action;
    action_.reset();
    return Progress::rests_in_hold;
  }
  if (ahead() >= ahead_.horizon && stages_.link.busy()) return Progress::waits;
  if (!stages_.items.next(item_)) {
    ended_ = true;
  } else if (const auto* segment = std::get_if<BoardSegment>(&item_)) {
    if (stages_.outputs.go_on()) pass_on_outputs();
    waiting_.emplace_back(*segment);
  } else if (const auto* outputs = std::get_if<PathOutputs>(&item_)) {
    stages_.outputs.apply(*outputs);
    pass_on_outputs();
  } else {
    action_ = std::get<Action>(item_);
    if (action_->kind == Action::Kind::feed_hold && stages_.outputs.halt()) pass_on_outputs();
    if (is_for_outputs(*action_, options_.waits_for_operator)) {
      stages_.outputs.apply(*std::exchange(action_, std::nullopt));
      pass_on_outputs();
    }
  }
  return send_waiting() ? Progress::goes_on : Progress::waits;
}

// False: something still waits for room on the board.
bool DirectFeed::send_waiting() {
  for (; !waiting_.empty() && stages_.link.room() > 0; waiting_.pop_front()) {
    std::visit([this](const auto& one) { stages_.link.send(one); }, waiting_.front());
  }
  return waiting_.empty();
}

bool DirectFeed::settled() {
  return stages_.link.error() || (send_waiting() && !stages_.link.busy());
}

std::optional<Point> DirectFeed::drop() {
  if (options_.reads_again) given_ = stages_.path.last();
  return {};
}

void DirectFeed::read_again() {
  if (!options_.reads_again) return;
  stages_.path.rewind(given_);
  stages_.planner.restart();
}

void DirectFeed::cut_dwell() {
  planned_ -= stages_.generator.cut_dwell();
}

}  // namespace passo
