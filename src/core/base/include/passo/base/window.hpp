// Window<T>: the known part of an endless sequence; elements are accessed by their number in the sequence. The window
// grows at its end and is dropped from its front. The memory of dropped elements is reused.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace passo {

template <class T>
class Window {
 public:
  std::uint64_t first() const { return first_; }
  std::uint64_t end() const { return end_; }
  bool empty() const { return first_ == end_; }

  T& operator[](std::uint64_t number) {
    assert(number >= first_ && number < end_);
    return elements_[number & (elements_.size() - 1)];
  }
  const T& operator[](std::uint64_t number) const {
    assert(number >= first_ && number < end_);
    return elements_[number & (elements_.size() - 1)];
  }
  T& front() { return (*this)[first_]; }
  const T& front() const { return (*this)[first_]; }
  T& back() { return (*this)[end_ - 1]; }

  // Adds an element at the end, for the caller to fill. Until then it holds old data of a dropped element.
  T& append() {
    if (end_ - first_ == elements_.size()) grow();
    ++end_;
    return back();
  }
  void drop_before(std::uint64_t number) {
    if (number > first_) first_ = number < end_ ? number : end_;
  }
  void drop_back() { --end_; }
  void drop_front() { drop_before(first_ + 1); }
  void clear() { first_ = end_; }

 private:
  void grow() {
    std::vector<T> larger(elements_.size() * 2);
    for (std::uint64_t i = first_; i < end_; ++i) {
      larger[i & (larger.size() - 1)] = std::move(elements_[i & (elements_.size() - 1)]);
    }
    elements_ = std::move(larger);
  }

  std::vector<T> elements_ = std::vector<T>(16);  // a power of two
  std::uint64_t first_ = 0;
  std::uint64_t end_ = 0;
};

}  // namespace passo
