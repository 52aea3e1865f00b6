// RunawayGuard: stops a program that repeats itself without end. It limits the number of loop passes and calls while
// the machine does nothing, and the number of steps (passes, calls and operations) within an outermost loop or call.
#pragma once

#include <cstdint>

namespace passo {

class RunawayGuard {
 public:
  struct Limits {
    std::uint64_t idle_passes = 0;
    std::uint64_t repeated_steps = 0;
    std::uint64_t main_passes = 1;
  };
  // idle: too many passes while the machine did nothing. steps: too many in total.
  enum class Reached : std::uint8_t { nothing, idle, steps };

  explicit RunawayGuard(const Limits& limits) : limits_(limits) {}
  const Limits& limits() const { return limits_; }

  // Notes the begin of an outermost loop, call or cycle.
  void begin() { steps_ = 0; }
  // Counts an operation. `works`: the machine does something, so the loops are not idle.
  void count_operation(bool works) {
    ++steps_;
    if (works) idle_passes_ = idle_calls_ = 0;
  }
  Reached count_pass() { return count(idle_passes_); }
  Reached count_call() { return count(idle_calls_); }
  bool allows_more_operations() const { return steps_ <= limits_.repeated_steps; }

  // Counts a pass of the main program. Returns whether it may run again.
  bool count_main_pass() { return ++main_passes_ != limits_.main_passes; }
  // Counts a restart. Returns false after too many restarts while the machine did nothing.
  bool count_restart() { return ++idle_passes_ <= limits_.idle_passes; }

  // Counts a call of a missing subroutine. Returns true for the last one that is allowed.
  bool is_last_unknown_call() { return ++unknown_calls_ == most_unknown_calls; }

 private:
  static constexpr std::uint64_t most_unknown_calls = 1000;

  Reached count(std::uint64_t& idle) {
    if (++idle > limits_.idle_passes) return Reached::idle;
    return ++steps_ > limits_.repeated_steps ? Reached::steps : Reached::nothing;
  }

  Limits limits_;
  std::uint64_t idle_passes_ = 0;  // number of passes since the machine last did something
  std::uint64_t idle_calls_ = 0;   // number of calls since then
  std::uint64_t steps_ = 0;        // number of passes, calls and operations since begin()
  std::uint64_t main_passes_ = 0;
  std::uint64_t unknown_calls_ = 0;
};

}  // namespace passo
