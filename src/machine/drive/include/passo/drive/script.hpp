// Script: a sequence of steps to do at standstill, with waits between them. No step blocks: a wait is a condition that
// each call of go_on() checks again.
#pragma once

#include <deque>
#include <functional>
#include <utility>

namespace passo {

class Script {
 public:
  using Act = std::function<void()>;
  using Condition = std::function<bool()>;

  // Adds a step at the end of the script. A step may add further steps.
  void then(Act act) {
    steps_.push_back([act = std::move(act)] {
      act();
      return true;
    });
  }
  void until(Condition condition) { steps_.push_back(std::move(condition)); }
  void clear() { steps_.clear(); }

  // Runs all steps that are possible now. Returns true if none is left.
  [[nodiscard]] bool go_on() {
    while (!steps_.empty()) {
      // Moved out first, because the step may clear the script, including itself.
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
