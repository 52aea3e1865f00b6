// PlayedMotion: passes the motion that a board has executed to an observer.
//
// With a board on a link, motion is planned ahead, and a part of it may never be executed: the machine stops with a
// stop ramp, and the path is planned again from its end. PlayedMotion keeps planned motion until the board has executed
// it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "passo/trajectory/phase.hpp"

namespace passo {

class PlayedMotion {
 public:
  void watch(std::function<void(const MotionItem&)> watcher) { watcher_ = std::move(watcher); }
  // Without an observer nothing is kept.
  bool is_watched() const { return watcher_ != nullptr; }

  void record_given(const MotionItem& motion) {
    if (is_watched()) given_.push_back(motion);
  }
  // The number of motion items planned since the beginning, without the dropped ones.
  std::uint64_t given() const { return shown_ + given_.size(); }

  // Reports the first `count` items as executed.
  void show(std::uint64_t count) {
    for (; shown_ < count && !given_.empty(); ++shown_, given_.pop_front()) watcher_(given_.front());
  }
  // Reports that the board has then executed this stop ramp.
  void show_tail(const std::vector<PlannedMove>& tail) const {
    for (const PlannedMove& move : tail) watcher_(move);
  }
  // Drops the unexecuted motion, which will never be executed.
  void forget() { given_.clear(); }

 private:
  std::function<void(const MotionItem&)> watcher_;
  std::deque<MotionItem> given_;
  std::uint64_t shown_ = 0;
};

}  // namespace passo
