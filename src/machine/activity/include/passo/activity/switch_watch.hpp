// SwitchWatch: the switches that a homing move watches, and whether the move ends when one of them closes or opens. A
// contact bounces, so a switch may change several times while its axis is homed; the number of changes is limited.
#pragma once

#include <cstdint>

namespace passo {

class SwitchWatch {
 public:
  static constexpr int most_changes = 8;

  void begin_axis() {
    changes_ = 0;
    until_closed_ = true;
  }
  void wait_for_closing() { until_closed_ = true; }
  void wait_for_opening() { until_closed_ = false; }
  bool until_closed() const { return until_closed_; }

  // Call when the switch was not in the expected state. Returns false after too many changes.
  [[nodiscard]] bool allows_another_try() { return ++changes_ <= most_changes; }
  // Call when the switch has changed unexpectedly: the next move waits for the opposite change. Returns false after too
  // many changes.
  [[nodiscard]] bool turn() {
    until_closed_ = !until_closed_;
    return allows_another_try();
  }

  // Bits of the limit inputs.
  void watch(unsigned inputs) { inputs_ = static_cast<std::uint8_t>(inputs); }
  std::uint8_t inputs() const { return inputs_; }

 private:
  bool until_closed_ = true;
  int changes_ = 0;
  std::uint8_t inputs_ = 0;
};

}  // namespace passo
