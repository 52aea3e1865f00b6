#include "passo/activity/line_queue.hpp"

#include <utility>

#include "passo/activity/nominal_time.hpp"

namespace passo {

void LineQueue::push(const PathItem& item) {
  time_ += nominal_time_of(item, limits_);
  items_.push_back(item);
}

// An empty queue has no time, whatever sums have rounded.
PathItem LineQueue::pull() {
  PathItem item = std::move(items_.front());
  items_.pop_front();
  time_ = items_.empty() ? Seconds(0) : time_ - nominal_time_of(item, limits_);
  return item;
}

void LineQueue::cut_to(std::size_t size) {
  for (; items_.size() > size; items_.pop_back()) time_ -= nominal_time_of(items_.back(), limits_);
  if (items_.empty()) time_ = Seconds(0);
}

void LineQueue::add_line(std::size_t before, Seconds now) {
  if (items_.empty()) return;
  last_came_ = now;
  if (before == 0) first_came_ = now;
}

bool LineQueue::has_room() const {
  return items_.size() < enough_items || (items_.size() < most_items && time_ < enough_time);
}

bool LineQueue::is_to_begin(Seconds now) const {
  if (items_.empty()) return false;
  return !has_room() || now - last_came_ >= quiet || now - first_came_ >= longest_wait;
}

bool LineQueue::expects_more(Seconds now) const {
  return items_.size() < enough_items && now - last_came_ < quiet;
}

}  // namespace passo
