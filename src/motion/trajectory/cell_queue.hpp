// CellQueue: the cells in the planner, with their demands, in a ring that grows up to a fixed size. Private to
// trajectory/.
#pragma once

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>
#include <vector>

#include "cell.hpp"

namespace passo {

class CellQueue {
 public:
  static constexpr double no_rest = std::numeric_limits<double>::infinity();
  struct Entry {
    Cell cell;
    // If the path stops at the entry: the squared speed limits of the entry and of the exit of the previous cell.
    double rest_cap = no_rest;
    double rest_exit = no_rest;
    double top_squared = 0;    // limit in the cell, with the feed override
    double entry_cap = 0;      // squared limit at the entry: by the tops on both sides, and by a stop
    double entry_if_rest = 0;  // the maximum squared entry speed if the path stopped after the queue
    double entry_if_open = 0;  // the same if the path continued straight without end
    // For a decided cell: the entry for which its exit was decided. Negative: the cell was changed since.
    double decided_entry = -1;
    double decided_exit = 0;

    bool begins_at_rest() const { return rest_cap < no_rest; }
    void rest_at(double exit_before, double entry) {
      rest_exit = exit_before;
      rest_cap = entry;
    }
    void go_on_at_entry() { rest_cap = no_rest; }
  };

  // `axes` is the maximum number of demands per cell; `falling_axes` of them have limits that fall with the speed.
  CellQueue(std::size_t capacity, std::size_t axes, std::size_t falling_axes)
      : capacity_(capacity), axes_(axes), falling_axes_(falling_axes) {
    resize(std::min(capacity, first_capacity) + 1);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  // Only for push(): push_front() always has room.
  bool full() const { return size_ >= capacity_; }
  Entry& operator[](std::size_t i) { return entries_[slot(i)]; }
  const Entry& operator[](std::size_t i) const { return entries_[slot(i)]; }
  Entry& back() { return (*this)[size_ - 1]; }
  std::span<const AxisDemand> demands(std::size_t i) const {
    const std::size_t at = slot(i);
    return {demands_.data() + at * axes_, entries_[at].cell.demand_count};
  }
  std::span<FallingDemand> falling(std::size_t i) {
    const std::size_t at = slot(i);
    return {falling_.data() + at * falling_axes_, entries_[at].cell.falling_count};
  }
  std::span<const FallingDemand> falling(std::size_t i) const {
    const std::size_t at = slot(i);
    return {falling_.data() + at * falling_axes_, entries_[at].cell.falling_count};
  }

  // Returns storage for one more cell, for one before all others, or for the first cell, cut again. Valid until the
  // next call.
  CellPlace push() {
    assert(!full());
    if (size_ + 1 >= entries_.size()) grow();
    return new_place(slot(size_++));
  }
  CellPlace push_front() {
    if (size_ == entries_.size()) grow();
    head_ = (head_ == 0 ? entries_.size() : head_) - 1;
    ++size_;
    return new_place(head_);
  }
  CellPlace front_again() { return place(head_); }
  void pop() {
    head_ = head_ + 1 == entries_.size() ? 0 : head_ + 1;
    --size_;
  }
  void clear() { size_ = 0; }

 private:
  static constexpr std::size_t first_capacity = 256;

  CellPlace new_place(std::size_t at) {
    entries_[at].go_on_at_entry();
    entries_[at].entry_if_rest = entries_[at].entry_if_open = 0;
    return place(at);
  }
  CellPlace place(std::size_t at) {
    entries_[at].decided_entry = -1;
    return {entries_[at].cell, demands_.data() + at * axes_, falling_.data() + at * falling_axes_};
  }
  void grow() {
    const auto turn = [this](auto& ring, std::size_t each) {
      std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(head_ * each), ring.end());
    };
    turn(entries_, 1);
    turn(demands_, axes_);
    turn(falling_, falling_axes_);
    head_ = 0;
    resize(std::max(std::min(2 * size_, capacity_), size_) + 1);
  }
  void resize(std::size_t places) {
    entries_.resize(places);
    demands_.resize(places * axes_);
    falling_.resize(places * falling_axes_);
  }
  std::size_t slot(std::size_t i) const {
    const std::size_t at = head_ + i;
    return at < entries_.size() ? at : at - entries_.size();
  }

  std::size_t capacity_;
  std::size_t axes_;
  std::size_t falling_axes_;
  std::vector<Entry> entries_;
  std::vector<AxisDemand> demands_;
  std::vector<FallingDemand> falling_;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
};

}  // namespace passo
