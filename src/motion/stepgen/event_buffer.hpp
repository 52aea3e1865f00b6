// EventBuffer: the events that will become board segments, with their exact times and each motor's exact position.
//
// A stretch is a series of events with the same master motor. Events are at the times when the master's position
// crosses multiples of `grid`. So the master's increment is exactly the grid, and its steps come at the exact times.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "lanes.hpp"

#include "passo/wire/board_segment.hpp"

namespace passo {

struct Stretch {
  unsigned master = 0;
  int sign = 1;                    // direction of the master
  std::int64_t grid = whole_step;  // position difference between two events: 65536 / 2^k
};

class EventBuffer {
 public:
  EventBuffer() = default;
  EventBuffer(const EventBuffer& other) { *this = other; }
  EventBuffer& operator=(const EventBuffer& other) {
    // Copies only the used part, because the whole buffer has 300 kilobytes.
    const auto copy = [&](const auto& from, auto& to, std::size_t end) {
      std::copy(from.begin() + static_cast<std::ptrdiff_t>(other.first_),
                from.begin() + static_cast<std::ptrdiff_t>(end),
                to.begin() + static_cast<std::ptrdiff_t>(other.first_));
    };
    const std::size_t end = other.last_ + other.hidden_;
    copy(other.time_, time_, end);
    for (unsigned m = 0; m < max_motors; ++m) copy(other.place_[m], place_[m], end + 1);
    first_ = other.first_;
    last_ = other.last_;
    hidden_ = other.hidden_;
    return *this;
  }

  std::size_t size() const { return last_ - first_; }
  bool empty() const { return first_ == last_; }

  std::int64_t time(std::size_t i) const { return time_[first_ + i]; }
  // Index 0 is the event before the first one in the buffer.
  const double* places(unsigned motor) const { return &place_[motor][first_]; }

  // Adds an event with its exact time and each motor's exact position. The time is in 1/65536 tick, with half a tick
  // added as on the board.
  void push(std::int64_t time, const std::array<double, max_motors>& places, unsigned motors) {
    if (last_ == capacity) make_room();
    time_[last_] = time;
    ++last_;
    for (unsigned m = 0; m < motors; ++m) place_[m][last_] = places[m];
  }
  // Adds the first `count` of several events.
  void push(const std::array<std::int64_t, lane_count>& times, const std::array<Lanes, max_motors>& places,
            std::size_t count, unsigned motors) {
    if (last_ + count > capacity) make_room();
    std::copy_n(times.begin(), count, &time_[last_]);
    for (unsigned m = 0; m < motors; ++m) std::copy_n(places[m].begin(), count, &place_[m][last_ + 1]);
    last_ += count;
  }
  void drop(std::size_t events) { first_ += events; }
  // Takes the events after the last one that makes a step out of the buffer, until show_hidden(). Add no events
  // meanwhile.
  void hide_events_without_steps(unsigned motors) {
    const std::size_t end = last_;
    while (last_ > first_ && !makes_step(last_, motors)) --last_;
    hidden_ = end - last_;
  }
  void show_hidden() { last_ += std::exchange(hidden_, 0); }
  // Empties the buffer. `before` are the positions at the event before the first.
  void restart(const std::array<double, max_motors>& before) {
    first_ = last_ = 0;
    for (unsigned m = 0; m < max_motors; ++m) place_[m][0] = before[m];
  }

 private:
  static constexpr std::size_t capacity = 4096;  // twice the number that a segment needs, so that events are rarely
                                                 // moved

  // Of the event before index `end`.
  bool makes_step(std::size_t end, unsigned motors) const {
    for (unsigned m = 0; m < motors; ++m) {
      if (std::floor(place_[m][end] / whole_step) != std::floor(place_[m][end - 1] / whole_step)) return true;
    }
    return false;
  }
  void make_room() {
    std::copy(time_.begin() + static_cast<std::ptrdiff_t>(first_), time_.begin() + static_cast<std::ptrdiff_t>(last_),
              time_.begin());
    for (auto& places : place_) {
      std::copy(places.begin() + static_cast<std::ptrdiff_t>(first_),
                places.begin() + static_cast<std::ptrdiff_t>(last_ + 1), places.begin());
    }
    last_ -= first_;
    first_ = 0;
  }

  std::array<std::int64_t, capacity> time_;
  std::array<std::array<double, capacity + 1>, max_motors> place_;  // one more: the event before the first
  std::size_t first_ = 0;
  std::size_t last_ = 0;
  std::size_t hidden_ = 0;  // events after the last one
};

}  // namespace passo
