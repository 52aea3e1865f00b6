#include "passo/controller/refiller.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cassert>
#include <limits>
#include <utility>

#include "board_outputs.hpp"

namespace passo {
namespace {

constexpr int smallest_refill = 4;  // items

// The planner's braking, handed out as motion.
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

Refiller::Refiller(const Stages& stages, const StepOptions& steps, const TailOptions& options)
    : stages_(stages),
      steps_(steps),
      options_(options),
      behind_(stages.link.executed()),
      places_(stages.link.room()),
      tail_size_(static_cast<std::size_t>(places_ / 4)) {
  stages.path.keep();
  stages.planner.limit_moves_to(options.longest_move);
  stages.generator.limit_waiting_to(options.longest_move);
  if (getenv("ONE")) { options_.motion.one_in = atoi(getenv("ONE")); options_.motion.least_rate = Hertz(atof(getenv("LEAST"))); }
  stages.generator.be_exact_to(options_.motion);
}

Refiller::Turn Refiller::advance() {
  if (stages_.link.error()) return Turn::ended;
  note_executed();
  if (items_.empty() && !on_tail_ && !holds_ && !ended_ && ahead_ < options_.refill_at && room_for_motion() > 0)
    gather();
  if (!items_.empty() && send()) return Turn::goes_on;
  if (!items_.empty() && refills_under_way_.empty() && stages_.link.room() == places_) return gather_less();
  const bool idle = items_.empty() && refills_under_way_.empty();
  if (idle && ended_) return Turn::ended;
  if (idle && std::exchange(holds_, false)) return Turn::rests_in_hold;
  stages_.link.wait();
  return Turn::goes_on;
}

// What the board has told of how far it is.
void Refiller::note_executed() {
  const ItemNumber executed = stages_.link.executed();
  show_executed(executed);
  for (; !motion_.empty() && later_by(motion_.front().number, executed) <= 0; motion_.pop_front()) {
    ahead_ -= motion_.front().time;
  }
  auto& under_way = refills_under_way_;
  while (under_way.size() > 1 && later_by(executed, under_way[1].first) >= 0) under_way.pop_front();
  if (under_way.empty() || later_by(executed, under_way.front().first) < 0) return;
  stages_.path.forget_before(under_way.front().rest.item);
  on_tail_ = later_by(executed, under_way.front().last_of_motion) > 0;
  if (executed != under_way.front().last) return;
  Refill played = std::move(under_way.front());
  under_way.pop_front();
  if (on_tail_) {
    take_up(played);
    ++recoveries_;
  } else {
    origin_ = std::move(played);
  }
}

// A tail was played if the board is in it, or at its end, where it waits; if it is further, another refill had come.
void Refiller::show_executed(ItemNumber executed) {
  for (; !sent_.empty() && later_by(sent_.front().number, executed) <= 0; sent_.pop_front()) {
    const Sent& sent = sent_.front();
    if (!sent.end_of_tail || later_by(executed, *sent.end_of_tail) <= 0) executed_watcher_(sent.item);
  }
}

// The board rests at the end of a tail. All that was sent behind it came too late.
void Refiller::take_up(const Refill& refill) {
  refills_under_way_.clear();
  sent_.clear();
  motion_.clear();
  items_.clear();
  ahead_ = Seconds(0);
  on_tail_ = holds_ = ended_ = false;
  behind_ = refill.last;
  given_ = refill.rest;
  stages_.path.rewind(refill.rest);
  stages_.planner.restart();
  stages_.generator.assume(*refill.rested);
}

// What was gathered from rest does not fit, though all places are free: once more from there, with half of the motion.
Refiller::Turn Refiller::gather_less() {
  most_at_rest_ = motion_items_ / 2;
  if (most_at_rest_ == 0) {
    stages_.link.fail(LinkError::too_few_places);
    return Turn::ended;
  }
  take_up(origin_);
  return Turn::goes_on;
}

// Its generator goes on as the one at hand, with other motion.
void Refiller::fork(Source<MotionItem>& motion, Refill& refill) const {
  refill.rested = std::make_unique<StepGenerator>(motion, steps_);
  refill.rested->assume(stages_.generator);
}

// Beside what the board holds, with its tail. A refill of next to nothing is not worth its tail, nor is one that leaves
// no room for the next: as long as there is time, less motion is sent for that.
std::size_t Refiller::room_for_motion() const {
  static const int extra = getenv("EXTRA") ? atoi(getenv("EXTRA")) : 2;
  static const int least_at = getenv("LEASTM") ? atoi(getenv("LEASTM")) : 4;
  const int tail = static_cast<int>(tail_size_ + tail_size_ / 4) + extra;
  const int room = stages_.link.room() - 1 - tail;
  const int for_next = tail + smallest_refill;
  if (refills_under_way_.empty()) return static_cast<std::size_t>(std::max(room - for_next, 2 * smallest_refill));
  const bool urgent = ahead_ < options_.refill_at / 2;
  const int wanted = urgent ? room : room - for_next / 2;
  return wanted < (urgent ? least_at : 2 * least_at) ? 0 : static_cast<std::size_t>(wanted);
}

// Motion up to the horizon, and how it would come to rest behind that.
void Refiller::gather() {
  refill_ = {};
  Seconds time{0};
  std::size_t most = room_for_motion();
  if (refills_under_way_.empty()) {
    most = std::min(most, most_at_rest_);
    Braking none(plan_);
    origin_.last = behind_;
    origin_.rest = given_;
    fork(none, origin_);
  }
  // Where what was pulled comes to rest by itself, that is the end of the refill: it needs no tail.
  const auto wanted = [&] {
    const StepGenerator& generator = stages_.generator;
    return (ahead_ + time < options_.horizon && items_.size() < most) ||
           (generator.ends_at_rest() && !generator.at_rest());
  };
  while (!holds_ && !ended_ && wanted()) {
    if (!stages_.items.next(item_)) {
      ended_ = true;
    } else if (const auto* segment = std::get_if<BoardSegment>(&item_)) {
      items_.emplace_back(*segment);
      time += time_of(items_.back());
    } else if (const auto& action = std::get<Action>(item_); action.kind == Action::Kind::feed_hold) {
      holds_ = true;
    } else {
      items_.emplace_back(board_outputs(action.outputs));
    }
  }
  motion_items_ = items_.size();
  refill_.rest = given_;
  if (motion_items_ > 0 && !stages_.generator.at_rest()) {
    gather_tail();
  } else {
    Braking none(plan_);
    fork(none, refill_);
  }
  tail_size_ = items_.size() - motion_items_;
}

void Refiller::gather_tail() {
  [[maybe_unused]] const bool known = stages_.planner.braking_plan(plan_);
  assert(known);
  for (const PlannedMove& move : plan_) refill_.rest = stages_.path.behind(refill_.rest, move);
  Braking braking(plan_);
  fork(braking, refill_);
  refill_.rested->be_exact_to(options_.tail);
  while (refill_.rested->next(item_)) items_.emplace_back(std::get<BoardSegment>(item_));
}

// False while there is no room.
bool Refiller::send() {
  if (stages_.link.room() <= static_cast<int>(items_.size())) return false;
  refill_.first = stages_.link.replace(behind_, items_);
  for (std::size_t i = 0; i < motion_items_; ++i) {
    motion_.push_back({.number = static_cast<ItemNumber>(refill_.first + i), .time = time_of(items_[i])});
    ahead_ += motion_.back().time;
  }
  refill_.last_of_motion = behind_ = static_cast<ItemNumber>(refill_.first + motion_items_ - 1);
  refill_.last = static_cast<ItemNumber>(refill_.first + items_.size() - 1);
  for (std::size_t i = 0; executed_watcher_ && i < items_.size(); ++i) {
    Sent sent{.number = static_cast<ItemNumber>(refill_.first + i), .item = items_[i]};
    if (i >= motion_items_) sent.end_of_tail = refill_.last;
    sent_.push_back(sent);
  }
  tail_items_ += items_.size() - motion_items_;
  if (getenv("DBG")) {  // TEMP
    double tt = 0, mt = 0; int te = 0, me = 0;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (auto* g = std::get_if<BoardSegment>(&items_[i])) { (i < motion_items_ ? mt : tt) += time_of(items_[i]).value(); (i < motion_items_ ? me : te) += g->events; }
    }
    fprintf(stderr, "R motion %zu %.4f s %d ev tail %zu %.4f s %d ev ahead %.4f room %d rec %d\n", motion_items_, mt, me, items_.size() - motion_items_, tt, te, ahead_.value(), stages_.link.room(), recoveries_);
    if (getenv("DBG")[0] == '2') for (std::size_t i = 0; i < items_.size(); ++i) if (auto* g = std::get_if<BoardSegment>(&items_[i])) fprintf(stderr, "   %s %d ev interval %.1f change %.4f dirs %d flips %d inc %d %d %d\n", i < motion_items_ ? "m" : "t", g->events, g->interval / 65536., g->change / 65536., g->directions, g->flips, g->increments[0], g->increments[1], g->increments[2]);
  }
  ++refills_;
  most_at_rest_ = std::numeric_limits<std::size_t>::max();
  refills_under_way_.push_back(std::move(refill_));
  items_.clear();
  return true;
}

Seconds Refiller::time_of(const LinkItem& item) const {
  const auto* segment = std::get_if<BoardSegment>(&item);
  if (segment == nullptr) return Seconds(0);
  const double events = segment->events;
  const double time = events * segment->interval + events * (events - 1) / 2 * segment->change;
  return Seconds(time / static_cast<double>(whole_tick) / steps_.clock.tick_rate.value());
}

}  // namespace passo
