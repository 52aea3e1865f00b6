// SpindleCounter: a spindle encoder, counted by a timer. Pulses take no processor time, at any rate.
//
// The index sets the capture flag of another timer, which is polled. While nothing is played, the flag is seen within a
// few microseconds; during motion the count at the index may be read some thousand cycles too late. Timer 1, whose
// compare matches make the steps, gives the time.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "serial_line.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

class SpindleCounter {
 public:
  static constexpr bool exists() { return pins.encoder.exists(); }

  // Timer 5 counts rising edges. Timer 4 captures the index: a falling edge that is sampled low four times in a row.
  static void prepare() {
    if (!exists()) return;
    Tccr5a::write(0);
    Tccr5b::write(7);
    Tccr4b::write(static_cast<uint8_t>(Tccr4b::read() | 1 << 7));
    Tifr4::write(input_captured);
  }

  // Call before 65,536 pulses or ticks have passed.
  [[gnu::always_inline]] static void poll() {
    if (!exists()) return;
    if ((Tifr4::read() & input_captured) != 0) on_index();
    if ((Tifr1::read() & timer_overflow) != 0) on_overflow();
  }
  // Whether timer 1 has overflowed since the last call. This class clears the timer's flag.
  static bool take_tick() {
    const bool tick = ticked_;
    ticked_ = false;
    return tick;
  }

  [[gnu::noinline]] static SpindleCount count() {
    poll();
    SerialLine::breathe();
    const uint16_t time = time_now();
    count_pulses();
    // An overflow that is not counted yet is added only if the time is after it.
    const bool overflowed = (Tifr1::read() & timer_overflow) != 0 && time < 0x8000;
    const uint16_t overflows = static_cast<uint16_t>(overflows_ + (overflowed ? 1 : 0));
    return {.count = count_,
            .tick = static_cast<uint32_t>(overflows) << 16 | time,
            .at_index = at_index_,
            .indexes = indexes_};
  }

 private:
  [[gnu::noinline]] static void on_overflow() {
    Tifr1::write(timer_overflow);
    ++overflows_;
    ticked_ = true;
    count_pulses();
  }
  [[gnu::noinline]] static void on_index() {
    Tifr4::write(input_captured);
    count_pulses();
    at_index_ = count_;
    ++indexes_;
  }
  static void count_pulses() {
    const uint16_t now = pulses();
    count_ += static_cast<uint16_t>(now - pulses_);
    pulses_ = now;
  }
  static uint16_t pulses() {
    const uint8_t low = Tcnt5l::read();
    return static_cast<uint16_t>(low | Tcnt5h::read() << 8);
  }
  // The interrupt writes its compare register through the same temporary byte that reading the count needs, so it must
  // not come in between.
  static uint16_t time_now() {
    constexpr uint16_t without_interrupt = 40;  // cycles from one reading to the next
    for (;;) {
      const uint16_t first = one_time();
      const uint16_t second = one_time();
      if (static_cast<uint16_t>(second - first) < without_interrupt) return second;
    }
  }
  static uint16_t one_time() {
    const uint8_t low = Tcnt1l::read();
    return static_cast<uint16_t>(low | Tcnt1h::read() << 8);
  }

  static inline uint16_t pulses_ = 0;
  static inline uint32_t count_ = 0;
  static inline uint32_t at_index_ = 0;
  static inline uint8_t indexes_ = 0;
  static inline uint16_t overflows_ = 0;
  static inline bool ticked_ = false;
};
#ifdef __AVR_ATmega2560__
static_assert(!SpindleCounter::exists() || (pins.encoder.pulses == Pin{'L', 2} && pins.encoder.index == Pin{'L', 0}),
              "timer 5 counts on D47, timer 4 captures on D49");
#else
static_assert(!SpindleCounter::exists(), "its timers are the steps' and the spindle's");
#endif

}  // namespace passo::chip
