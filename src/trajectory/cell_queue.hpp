// CellQueue: the cells that the planner has in hand, with their demands, in a ring of fixed size. Private to
// trajectory/.
#pragma once

#include <cassert>
#include <span>
#include <vector>

#include "cell.hpp"

namespace passo {

class CellQueue {
 public:
  struct Entry {
    Cell cell;
    std::size_t demand_count = 0;
    std::size_t falling_count = 0;
    bool begins_at_rest = false;
    double top_squared = 0;    // of the cell, with the override of the feed
    double entry_cap = 0;      // squared: by the tops on both sides, 0 at a rest
    double entry_if_rest = 0;  // how fast it may be entered if the path came to rest behind the queue
    double entry_if_open = 0;  // the same if the path went straight on there for ever
  };

  // `axes`: the most demands a cell makes; the limits of `falling_axes` of them fall with the speed.
  CellQueue(std::size_t capacity, std::size_t axes, std::size_t falling_axes)
      : axes_(axes),
        falling_axes_(falling_axes),
        entries_(capacity + 1),
        demands_((capacity + 1) * axes),
        falling_((capacity + 1) * falling_axes) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  // One place is left for push_front().
  bool full() const { return size_ + 1 >= entries_.size(); }
  Entry& operator[](std::size_t i) { return entries_[slot(i)]; }
  const Entry& operator[](std::size_t i) const { return entries_[slot(i)]; }
  Entry& back() { return (*this)[size_ - 1]; }
  std::span<const AxisDemand> demands(std::size_t i) const {
    const std::size_t at = slot(i);
    return {demands_.data() + at * axes_, entries_[at].demand_count};
  }
  std::span<FallingDemand> falling(std::size_t i) {
    const std::size_t at = slot(i);
    return {falling_.data() + at * falling_axes_, entries_[at].falling_count};
  }
  std::span<const FallingDemand> falling(std::size_t i) const {
    const std::size_t at = slot(i);
    return {falling_.data() + at * falling_axes_, entries_[at].falling_count};
  }

  Entry& push(const CellCutter::Piece& piece) {
    assert(!full());
    const std::size_t at = slot(size_++);
    entries_[at] = {};
    return put(piece, at);
  }
  // Once between two calls of pop().
  void push_front(const CellCutter::Piece& piece) {
    head_ = (head_ == 0 ? entries_.size() : head_) - 1;
    ++size_;
    entries_[head_] = {};
    replace_front(piece);
  }
  // The first cell, cut anew.
  void replace_front(const CellCutter::Piece& piece) { put(piece, head_); }
  void pop() {
    head_ = head_ + 1 == entries_.size() ? 0 : head_ + 1;
    --size_;
  }

 private:
  Entry& put(const CellCutter::Piece& piece, std::size_t at) {
    assert(piece.demand_count <= axes_ && piece.falling_count <= falling_axes_);
    for (std::size_t k = 0; k < piece.demand_count; ++k) demands_[at * axes_ + k] = piece.demands[k];
    for (std::size_t k = 0; k < piece.falling_count; ++k) falling_[at * falling_axes_ + k] = piece.falling[k];
    Entry& entry = entries_[at];
    entry.cell = piece.cell;
    entry.demand_count = piece.demand_count;
    entry.falling_count = piece.falling_count;
    return entry;
  }
  std::size_t slot(std::size_t i) const {
    const std::size_t at = head_ + i;
    return at < entries_.size() ? at : at - entries_.size();
  }

  std::size_t axes_;
  std::size_t falling_axes_;
  std::vector<Entry> entries_;
  std::vector<AxisDemand> demands_;
  std::vector<FallingDemand> falling_;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
};

}  // namespace passo
