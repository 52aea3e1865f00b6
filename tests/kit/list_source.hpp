// ListSource: feeds a stage from a list, for tests and benchmarks.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "passo/base/source.hpp"

namespace passo::test {

template <class T>
class ListSource final : public Source<T> {
 public:
  explicit ListSource(std::vector<T> items) : items_(std::move(items)) {}
  [[nodiscard]] bool next(T& item) override {
    if (at_ == items_.size()) return false;
    item = items_[at_++];
    return true;
  }

 private:
  std::vector<T> items_;
  std::size_t at_ = 0;
};

}  // namespace passo::test
