// PulledItems: what a refiller has pulled from the step generator and not sent yet, and how the path goes on behind it.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "passo/drive/speed_for_tails.hpp"
#include "passo/drive/tail_maker.hpp"

namespace passo {

class PulledItems {
 public:
  struct Item {
    LinkItem item;
    Seconds time{0};
    SpeedForTails::Speed speed = {};       // about the speed at its end
    std::optional<BrakingTail> tail = {};  // after the item; empty: no refill may end here
  };

  void add(const LinkItem& item, Seconds time, const SpeedForTails::Speed& speed);
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  Item& operator[](std::size_t i) { return items_[i]; }
  const Item& operator[](std::size_t i) const { return items_[i]; }
  Item& last() { return items_.back(); }
  Seconds time() const { return time_; }
  // True: after the last item, a refill may end.
  bool may_end() const { return items_.empty() || items_.back().tail; }
  // True: it is worth looking for a tail after the last item.
  bool is_far_from_last_tail() const;
  SpeedForTails::Speed highest_speed() const;
  // The first items are sent.
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
  bool holds_ = false;            // after the items, the planner holds
  bool ended_ = false;            // after the items, the path has ended
  std::optional<Action> action_;  // after the items, this is to be done
};

}  // namespace passo
