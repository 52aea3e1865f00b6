#include "passo/drive/pulled_items.hpp"

#include <algorithm>

namespace passo {
namespace {

// At least this much motion, or this many items, lie between two places where a refill may end, because finding a tail
// takes time.
constexpr Seconds between_tails{0.0025};
constexpr std::size_t items_between_tails = 3;

}  // namespace

void PulledItems::add(const LinkItem& item, Seconds time, const StopRampSpeedLimiter::Speed& speed) {
  items_.push_back({.item = item, .time = time, .speed = speed});
  time_ += time;
}

bool PulledItems::is_far_from_last_tail() const {
  Seconds time{0};
  std::size_t items = 0;
  for (auto at = items_.rbegin(); at != items_.rend() && !at->tail; ++at, ++items) time += at->time;
  return items >= items_between_tails || time >= between_tails;
}

StopRampSpeedLimiter::Speed PulledItems::highest_speed() const {
  StopRampSpeedLimiter::Speed highest;
  for (const Item& item : items_) {
    highest.on_path = std::max(highest.on_path, item.speed.on_path);
    highest.of_axis = std::max(highest.of_axis, item.speed.of_axis);
  }
  return highest;
}

void PulledItems::drop_first(std::size_t items) {
  for (std::size_t i = 0; i < items; ++i) time_ -= items_[i].time;
  items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(items));
}

void PulledItems::clear() {
  items_.clear();
  time_ = Seconds(0);
  holds_ = ended_ = false;
  action_.reset();
}

}  // namespace passo
