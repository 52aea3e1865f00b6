// LineQueue: a bounded queue of the path items of lines that arrive one by one. Its duration is the sum of its items'
// times. It decides when a stopped machine starts to move, and how long a moving machine may wait for another line.
#pragma once

#include <cstddef>
#include <deque>

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"
#include "passo/units/units.hpp"

namespace passo {

class LineQueue {
 public:
  // Above `enough_items`, items are accepted only while the queue's duration is at most `enough_time`, and never more
  // than `most_items`.
  static constexpr std::size_t enough_items = 256;
  static constexpr std::size_t most_items = 1024;
  static constexpr Seconds enough_time{10};
  // The machine starts to move when the queue is full, when no line has arrived for `quiet`, or when the first line has
  // waited for `longest_wait`. So the look-ahead sees more than the first line.
  static constexpr Seconds quiet{0.03};
  static constexpr Seconds longest_wait{0.5};

  explicit LineQueue(const MotionLimits& limits) : limits_(limits) {}

  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  Seconds time() const { return time_; }

  void push(const PathItem& item);
  // Call only while the queue is not empty.
  PathItem pull();
  // Drops all items after the first `size`.
  void cut_to(std::size_t size);
  void clear() { cut_to(0); }

  // Call after all items of a line were pushed. `before` is the queue's size before that line.
  void add_line(std::size_t before, Seconds now);
  bool has_room() const;
  bool is_to_begin(Seconds now) const;
  bool expects_more(Seconds now) const;

 private:
  MotionLimits limits_;
  std::deque<PathItem> items_;
  Seconds time_{0};
  Seconds first_came_{0};  // arrival time of the first line in the queue
  Seconds last_came_{0};
};

}  // namespace passo
