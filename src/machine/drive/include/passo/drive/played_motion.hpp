// PlayedMotion: shows the motion that a board has executed to who wants to see it.
//
// Over a line the planner gives motion ahead, and a part of it may never be played: the machine brakes by a tail, and
// the path is planned anew from where the tail ends. PlayedMotion keeps what was given until the board has executed it.
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
  // Without a watcher nothing is kept.
  bool is_watched() const { return watcher_ != nullptr; }

  void record_given(const MotionItem& motion) {
    if (is_watched()) given_.push_back(motion);
  }
  // How many were given since the beginning, without those that were forgotten.
  std::uint64_t given() const { return shown_ + given_.size(); }

  // The board has executed the first `count` of them.
  void show(std::uint64_t count) {
    for (; shown_ < count && !given_.empty(); ++shown_, given_.pop_front()) watcher_(given_.front());
  }
  // The board has then played this tail.
  void show_tail(const std::vector<PlannedMove>& tail) const {
    for (const PlannedMove& move : tail) watcher_(move);
  }
  // What was given and is not executed never will be.
  void forget() { given_.clear(); }

 private:
  std::function<void(const MotionItem&)> watcher_;
  std::deque<MotionItem> given_;
  std::uint64_t shown_ = 0;
};

}  // namespace passo
