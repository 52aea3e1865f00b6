// PulledItems: the items that a refiller has pulled from the step generator but not sent yet, and the continuation of
// the path after them.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "passo/drive/stop_ramp_planner.hpp"
#include "passo/drive/stop_ramp_speed_limiter.hpp"

namespace passo {

class PulledItems {
 public:
  struct Item {
    LinkItem item;
    Seconds time{0};
    StopRampSpeedLimiter::Speed speed = {};  // approximate speed at its end
    std::optional<StopRamp> tail = {};       // stop ramp after the item; empty: no queue update may end here
  };

  void add(const LinkItem& item, Seconds time, const StopRampSpeedLimiter::Speed& speed);
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  Item& operator[](std::size_t i) { return items_[i]; }
  const Item& operator[](std::size_t i) const { return items_[i]; }
  Item& last() { return items_.back(); }
  Seconds time() const { return time_; }
  // Returns true if a queue update may end after the last item.
  bool may_end() const { return items_.empty() || items_.back().tail; }
  // Returns true if it is worth computing a stop ramp after the last item.
  bool is_far_from_last_tail() const;
  StopRampSpeedLimiter::Speed highest_speed() const;
  // Removes the first `items` items, which were sent.
  void drop_first(std::size_t items);

  bool goes_on() const { return !holds_ && !ended_ && !action_; }
  void record_hold() { holds_ = true; }
  void record_end() { ended_ = true; }
  void record_action(const Action& action) { action_ = action; }
  bool ends() const { return ended_; }
  const std::optional<Action>& action() const { return action_; }
  Action take_action() { return *std::exchange(action_, std::nullopt); }
  [[nodiscard]] bool take_hold() { return std::exchange(holds_, false); }

  void clear();

 private:
  std::deque<Item> items_;
  Seconds time_{0};
  bool holds_ = false;            // the planner holds after the items
  bool ended_ = false;            // the path has ended after the items
  std::optional<Action> action_;  // to be performed after the items
};

}  // namespace passo
