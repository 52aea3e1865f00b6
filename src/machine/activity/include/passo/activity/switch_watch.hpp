// SwitchWatch: which switches a homing move watches, and whether the move ends when one of them closes or when it
// opens. A contact bounces, so a switch may change several times while its axis is homed, but not without end.
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

  // The switch was not as the move expected. False: that has happened too often.
  [[nodiscard]] bool allows_another_try() { return ++changes_ <= most_changes; }
  // The switch has changed by itself: the next move waits for the opposite. False: that has happened too often.
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
