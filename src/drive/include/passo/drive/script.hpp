// Script: what is to be done at rest, one thing after the other, with waits between. Nothing in a script blocks: a wait
// is a condition that is looked at again each time go_on() is called.
#pragma once

#include <deque>
#include <functional>
#include <utility>

namespace passo {

class Script {
 public:
  using Act = std::function<void()>;
  using Condition = std::function<bool()>;

  // Behind what the script holds already. An act may add to the script.
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
