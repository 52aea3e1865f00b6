#include "passo/drive/queue_update_ledger.hpp"

#include <algorithm>

#include "passo/base/ensure.hpp"
#include "passo/wire/segment_parts.hpp"

namespace passo {

Seconds QueueUpdateLedger::executed_time() const {
  const Seconds whole_items = passed_ + sent_time_ - ahead_;
  if (motion_.empty()) return whole_items;
  return whole_items + std::min(motion_.front().time, link_.now() - item_begins_);
}

void QueueUpdateLedger::record_given(const MotionItem& motion, Seconds time) {
  motion_played_.record_given(motion);
  given_time_ += time;
  given_in_all_ += time;
}

void QueueUpdateLedger::report_rest(ItemNumber executed, const PathPosition& place) const {
  if (rest_watcher_) rest_watcher_({.executed = executed, .place = place, .done = done_});
}

void QueueUpdateLedger::record_motion(const LinkItem& item, ItemNumber number, Seconds time) {
  if (motion_.empty()) item_begins_ = link_.now();
  sent_time_ += time;
  motion_.push_back({.number = number, .time = time, .end = sent_time_, .item = item});
  ahead_ += time;
  if (told_ahead_) *told_ahead_ += time;
  played_.record_sent(number, item, std::nullopt);
}

void QueueUpdateLedger::record_refill(Refill refill) {
  ensure(refill.last == link_.sent() && later_by(refill.last, refill.last_of_motion) >= 0);
  ItemNumber number = refill.last_of_motion;
  for (const LinkItem& item : refill.tail.items) played_.record_sent(++number, item, refill.last);
  counts_.tail_items += refill.tail.items.size();
  ++counts_.refills;
  refill.tail.items = {};
  under_way_.push_back(std::move(refill));
}

void QueueUpdateLedger::on_question() {
  longest_ahead_ = std::max(longest_ahead_, ahead_);
}

void QueueUpdateLedger::on_executed(ItemNumber executed) {
  played_.show_executed(executed);
  for (; !motion_.empty() && later_by(motion_.front().number, executed) <= 0; motion_.pop_front()) {
    ahead_ -= motion_.front().time;
    item_begins_ = link_.now();
  }
  for (; under_way_.size() > 1 && later_by(executed, under_way_[1].first) >= 0; under_way_.pop_front()) {
    motion_played_.show(under_way_.front().tail.motion_from);
    done_ = under_way_.front().tail.from;
  }
}

StopOnPath QueueUpdateLedger::end_refill(bool on_tail) {
  StopRamp tail = std::move(under_way_.front().tail);
  under_way_.pop_front();
  done_ = tail.rest.place;
  motion_played_.show(tail.motion_from);
  if (on_tail) motion_played_.show_tail(tail.motion);
  return std::move(tail.rest);
}

void QueueUpdateLedger::record_rest() {
  motion_played_.show(motion_played_.given());
  passed_ += sent_time_;
  given_time_ = sent_time_ = Seconds(0);
  began_.reset();
  told_ahead_.reset();
}

void QueueUpdateLedger::forget_unexecuted() {
  under_way_.clear();
  played_.forget();
  motion_played_.forget();
  motion_.clear();
  given_time_ = sent_time_ = sent_time_ - ahead_;
  given_in_all_ = passed_ + sent_time_;
  ahead_ = Seconds(0);
}

// All answers of one motion together give a better time.
Seconds QueueUpdateLedger::ahead_of(const Turned& turned, Seconds time) {
  Seconds played = sent_time_;
  Seconds next{0};
  for (const Motion& motion : motion_) {
    if (later_by(motion.number, turned.progress.executed) <= 0) continue;
    const Seconds begins = motion.end - motion.time;
    played = begins + time_of(motion.item, turned.event);
    next = begins + time_of(motion.item, turned.event + 1) - played;
    break;
  }
  const Seconds latest = time - played;
  began_ = std::clamp(began_.value_or(latest), latest - next, latest);
  told_ahead_ = sent_time_ - (time - *began_);
  return given_time_ - (time - *began_);
}

Seconds QueueUpdateLedger::time_of(const LinkItem& item, int of_events) const {
  const auto* segment = std::get_if<BoardSegment>(&item);
  if (segment == nullptr) return Seconds(0);
  return Seconds(static_cast<double>(duration(*segment, of_events)) / whole_tick / tick_rate_.value());
}

}  // namespace passo
