// EmulatedTimer: timers 0 (8 bits) and 1 (16 bits) of the ATmegas, free running or (timer 0) cleared by a match, each
// with its compare match A, and timer 1 with its overflow flag (no program uses the overflow as an interrupt). The
// class replaces simavr's timer, which loses a preset count, clears all flags when one is cleared, and loses a match
// that is pending when its interrupt is enabled.
//
// As on the real chip, 16-bit registers are accessed through their shared byte TEMP. A match sets its flag whether or
// not the interrupt is enabled. If a compare time has just passed when it is written, the next match is one full timer
// period later.
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

  // The cycle at which the running timer 1 was at 0.
  std::uint64_t started() const { return word_.started; }

 private:
  // A timer that counts to `turn` - 1, or to the compare value if a match clears it.
  struct Counter {
    std::uint64_t turn = 0;
    std::uint16_t flags = 0;  // addresses of TIFRn and TIMSKn
    std::uint16_t mask = 0;
    avr_int_vector_t* match = nullptr;
    std::uint64_t started = 0;
    std::uint64_t prescale = 0;  // cycles per count; 0: the timer is stopped
    bool clears_on_match = false;
    std::uint64_t compare = 0;

    std::uint64_t length() const { return clears_on_match ? compare + 1 : turn; }

    std::uint64_t count(const avr_t& avr) const;
    void start(avr_t& avr, std::uint8_t control);
    void set_alarm(avr_t& avr);
    void clear(avr_t& avr, std::uint8_t flags_written) const;
    void enable(avr_t& avr, std::uint8_t mask_written) const;
  };

  void replace_timer_0();
  void replace_timer_1();
  std::uint64_t overflows() const;
  static std::uint64_t on_match(avr_t* avr, std::uint64_t when, void* counter);

  avr_t& avr_;
  Counter byte_{.turn = 256, .flags = 0x35, .mask = 0x6e};
  Counter word_{.turn = 65536, .flags = 0x36, .mask = 0x6f};
  std::uint8_t temp_ = 0;
  std::uint64_t overflows_cleared_ = 0;
};

}  // namespace passo
