// PlayedItems: shows each item that the board has executed to who wants to see them, tails that were played included.
//
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "passo/link/link.hpp"

namespace passo {

class PlayedItems {
 public:
  void watch(std::function<void(const LinkItem&)> watcher) { watcher_ = std::move(watcher); }

  // Sent as motion; or as a part of the tail that ends with that item, which is played only if no refill comes.
  void record_sent(ItemNumber number, const LinkItem& item, std::optional<ItemNumber> end_of_tail) {
    if (watcher_) sent_.push_back({.number = number, .item = item, .end_of_tail = end_of_tail});
  }
  // Outputs that were sent by themselves, and are switched.
  void show(const LinkItem& item) const {
    if (watcher_) watcher_(item);
  }
  // A tail was played if the board is in it, or at its end, where it waits; if it is further, another refill had come.
  void show_executed(ItemNumber executed) {
    for (; !sent_.empty() && later_by(sent_.front().number, executed) <= 0; sent_.pop_front()) {
      const Sent& sent = sent_.front();
      if (!sent.end_of_tail || later_by(executed, *sent.end_of_tail) <= 0) watcher_(sent.item);
    }
  }
  // What was sent and is not executed never will be.
  void forget() { sent_.clear(); }

 private:
  struct Sent {
    ItemNumber number = 0;
    LinkItem item;
    std::optional<ItemNumber> end_of_tail = {};  // none: motion
  };

  std::function<void(const LinkItem&)> watcher_;
  std::deque<Sent> sent_;
};

}  // namespace passo
