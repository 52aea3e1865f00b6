// EmulatedTimer: timer 1 of the ATmegas, free running at the full clock, with its compare match A and its overflow flag
// (no program uses the overflow as an interrupt). The class replaces simavr's timer, which forgets a preset count,
// clears all flags when one is cleared, and forgets a match that was pending when its interrupt is enabled.
//
// As in silicon, 16-bit registers go through the one byte TEMP that they share. A match sets its flag whether the
// interrupt is enabled or not. A compare time that has just passed when it is written comes again after 65,536 cycles.
#pragma once

#include <cstdint>

struct avr_t;
struct avr_int_vector_t;

namespace passo {

class EmulatedChip;

class EmulatedTimer {
 public:
  explicit EmulatedTimer(EmulatedChip& chip);
  EmulatedTimer(const EmulatedTimer&) = delete;

  // The cycle at which the timer stood at 0 and ran.
  std::uint64_t started() const { return started_; }

 private:
  std::uint16_t count() const;
  std::uint64_t overflows() const;
  void set_alarm();
  static std::uint64_t on_match(avr_t* avr, std::uint64_t when, void* self);

  avr_t& avr_;
  avr_int_vector_t* match_ = nullptr;
  std::uint64_t started_ = 0;
  bool runs_ = false;
  std::uint8_t temp_ = 0;
  std::uint16_t compare_ = 0;
  std::uint64_t overflows_cleared_ = 0;
};

}  // namespace passo
