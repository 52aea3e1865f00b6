// Tap<T>: a stage between two others that passes each item to observers. An observer that takes a T& may mark the item
// for the later stages; all others take a const T&.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "passo/base/source.hpp"

namespace passo {

template <class T>
class Tap final : public Source<T> {
 public:
  using Watcher = std::function<void(T&)>;

  explicit Tap(Source<T>& source) : source_(source) {}
  void watch(Watcher watcher) { watchers_.push_back(std::move(watcher)); }

  [[nodiscard]] bool next(T& item) override {
    if (!source_.next(item)) return false;
    for (const Watcher& watcher : watchers_) watcher(item);
    return true;
  }

 private:
  Source<T>& source_;
  std::vector<Watcher> watchers_;
};

}  // namespace passo
