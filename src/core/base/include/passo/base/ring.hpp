// Ring<T, Capacity>: a bounded first-in first-out queue without a heap. Portable.
//
// Capacity is a power of two, so that an index is a mask. One producer and one consumer.
#pragma once

#include <stddef.h>

namespace passo {

template <class T, size_t Capacity>
class Ring {
  static_assert(Capacity > 0 && (Capacity & (Capacity - 1)) == 0, "a ring's capacity is a power of two");

 public:
  static constexpr size_t capacity() { return Capacity; }
  size_t size() const { return head_ - tail_; }
  bool empty() const { return head_ == tail_; }
  bool full() const { return size() == Capacity; }

  // The caller has checked full() before push(), and empty() before front().
  void push(const T& item) { items_[head_++ & (Capacity - 1)] = item; }
  const T& front() const { return items_[tail_ & (Capacity - 1)]; }
  // `index` counts from the front and is less than size().
  const T& at(size_t index) const { return items_[(tail_ + index) & (Capacity - 1)]; }
  // Returns the slot for the next item: write the item there, then call push(). The caller has checked full().
  T& space() { return items_[head_ & (Capacity - 1)]; }
  void push() { ++head_; }
  void pop() { ++tail_; }
  void clear() { tail_ = head_; }

 private:
  T items_[Capacity] = {};
  size_t head_ = 0;
  size_t tail_ = 0;
};

}  // namespace passo
