// Script: things to do at rest, one after the other, with waits between. Nothing in a script blocks: a wait is a
// condition that each call of go_on() checks again.
#pragma once

#include <deque>
#include <functional>
#include <utility>

namespace passo {

class Script {
 public:
  using Act = std::function<void()>;
  using Condition = std::function<bool()>;

  // Adds an act after all that the script already holds. An act may add to the script.
  void then(Act act) {
    steps_.push_back([act = std::move(act)] {
      act();
      return true;
    });
  }
  void until(Condition condition) { steps_.push_back(std::move(condition)); }
  void clear() { steps_.clear(); }

  // Does what can be done now. True: nothing is left.
  [[nodiscard]] bool go_on() {
    while (!steps_.empty()) {
      // The step may clear the script, and itself with it.
      const Condition step = std::move(steps_.front());
      steps_.pop_front();
      const std::size_t left = steps_.size();
      if (step()) continue;
      if (steps_.size() == left) steps_.push_front(step);
      return false;
    }
    return true;
  }
  bool empty() const { return steps_.empty(); }

 private:
  std::deque<Condition> steps_;
};

}  // namespace passo
