// SpindleCounter: a spindle encoder, counted by a PWM slice. Pulses take no processor time, at any rate. The index
// triggers an interrupt, which stores the count a fraction of a microsecond after the edge.
#pragma once

#include "pico_player.hpp"
#include "registers.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

class SpindleCounter {
 public:
  static constexpr bool exists() { return pins.has_encoder(); }

  static void prepare() {
    if (!exists()) return;
    pwm(slice, pwm_div) = 1U << 4;
    pwm(slice, pwm_top) = 0xffff;
    pwm(slice, pwm_ctr) = 0;
    pwm(slice, pwm_csr) = 2U << 4 | 1U;  // counts rising edges of its second pin
    gpio_ctrl(pins.encoder_pulses) = function_pwm;
  }
  static void listen() {
    if (exists()) gpio_interrupts(pins.encoder_index) = gpio_interrupts(pins.encoder_index) | falls;
  }

  // Call before 65,536 pulses have passed.
  static void poll() {
    if (!exists()) return;
    interrupts_off();
    count_pulses();
    interrupts_on();
  }
  // Handles the pin interrupt.
  [[gnu::always_inline]] static void index_moved() {
    if (!exists() || (gpio_edges(pins.encoder_index) & falls) == 0) return;
    count_pulses();
    at_index_ = count_;
    ++indexes_;
  }

  static SpindleCount count() {
    interrupts_off();
    count_pulses();
    // The board's clock ticks 16 times per microsecond.
    const SpindleCount now = {
        .count = count_, .tick = TimerLow::read() * 16, .at_index = at_index_, .indexes = indexes_};
    interrupts_on();
    return now;
  }

 private:
  static constexpr uint32_t slice = PicoPins::slice_of(pins.encoder_pulses);
  static constexpr uint32_t falls = edge_bits(pins.encoder_index, edge_low);

  [[gnu::always_inline]] static void count_pulses() {
    const uint16_t now = static_cast<uint16_t>(pwm(slice, pwm_ctr));
    count_ += static_cast<uint16_t>(now - pulses_);
    pulses_ = now;
  }

  static inline uint16_t pulses_ = 0;
  static inline uint32_t count_ = 0;
  static inline uint32_t at_index_ = 0;
  static inline uint8_t indexes_ = 0;
};

}  // namespace passo::chip
