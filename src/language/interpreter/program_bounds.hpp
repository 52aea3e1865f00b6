// ProgramBounds: when a program that repeats itself is stopped. It may go round its loops, or call, only so often while
// the machine does nothing, and come to only so many steps (passes, calls and operations) within its outermost loop or
// call.
#pragma once

#include <cstdint>

namespace passo {

class ProgramBounds {
 public:
  struct Limits {
    std::uint64_t idle_passes = 0;
    std::uint64_t repeated_steps = 0;
    std::uint64_t main_passes = 1;
  };
  // idle: too often while the machine did nothing. steps: too many in all.
  enum class Reached : std::uint8_t { nothing, idle, steps };

  explicit ProgramBounds(const Limits& limits) : limits_(limits) {}
  const Limits& limits() const { return limits_; }

  // The outermost loop, call or cycle begins.
  void begin() { steps_ = 0; }
  // Counts an operation. `works`: the machine does something, so the loops do.
  void count_operation(bool works) {
    ++steps_;
    if (works) idle_passes_ = idle_calls_ = 0;
  }
  Reached count_pass() { return count(idle_passes_); }
  Reached count_call() { return count(idle_calls_); }
  bool allows_more_operations() const { return steps_ <= limits_.repeated_steps; }

  // The main program has come to its end. True: it may run again.
  bool count_main_pass() { return ++main_passes_ != limits_.main_passes; }
  // It runs again. False: too often while the machine did nothing.
  bool count_restart() { return ++idle_passes_ <= limits_.idle_passes; }

  // A call of a sub that is not there. True: the last that is allowed.
  bool is_last_unknown_call() { return ++unknown_calls_ == most_unknown_calls; }

 private:
  static constexpr std::uint64_t most_unknown_calls = 1000;

  Reached count(std::uint64_t& idle) {
    if (++idle > limits_.idle_passes) return Reached::idle;
    return ++steps_ > limits_.repeated_steps ? Reached::steps : Reached::nothing;
  }

  Limits limits_;
  std::uint64_t idle_passes_ = 0;  // passes since the machine last did something
  std::uint64_t idle_calls_ = 0;   // calls since then
  std::uint64_t steps_ = 0;        // passes, calls and operations since begin()
  std::uint64_t main_passes_ = 0;
  std::uint64_t unknown_calls_ = 0;
};

}  // namespace passo
