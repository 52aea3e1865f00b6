// PlayedItems: passes each item that the board has executed to an observer, including executed stop ramps.
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "passo/link/link.hpp"

namespace passo {

class PlayedItems {
 public:
  void watch(std::function<void(const LinkItem&)> watcher) { watcher_ = std::move(watcher); }

  // Records an item that was sent as motion, or as a part of the stop ramp that ends with item `end_of_tail`. A stop
  // ramp is executed only if no queue update arrives.
  void record_sent(ItemNumber number, const LinkItem& item, std::optional<ItemNumber> end_of_tail) {
    if (watcher_) sent_.push_back({.number = number, .item = item, .end_of_tail = end_of_tail});
  }
  // Reports outputs that were sent separately and are switched.
  void show(const LinkItem& item) const {
    if (watcher_) watcher_(item);
  }
  // Reports all items up to `executed`. A stop ramp was executed if the board is in it, or waits at its end; if the
  // board is further, another queue update had arrived.
  void show_executed(ItemNumber executed) {
    for (; !sent_.empty() && later_by(sent_.front().number, executed) <= 0; sent_.pop_front()) {
      const Sent& sent = sent_.front();
      if (!sent.end_of_tail || later_by(executed, *sent.end_of_tail) <= 0) watcher_(sent.item);
    }
  }
  // Drops the unexecuted items, which will never be executed.
  void forget() { sent_.clear(); }

 private:
  struct Sent {
    ItemNumber number = 0;
    LinkItem item;
    std::optional<ItemNumber> end_of_tail = {};  // empty: motion
  };

  std::function<void(const LinkItem&)> watcher_;
  std::deque<Sent> sent_;
};

}  // namespace passo
