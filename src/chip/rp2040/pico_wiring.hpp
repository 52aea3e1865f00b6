// PicoWiring: all pins except the motors', taken from the pin map: switches and outputs.
#pragma once

#include "pico_player.hpp"
#include "registers.hpp"
#include "spindle_counter.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

class PicoWiring {
 public:
  static void prepare() {
    for (uint32_t gpio = 0; gpio < gpio_count; ++gpio) {
      const uint32_t bit = 1U << gpio;
      if ((pins.motor_pins() & bit) != 0) gpio_ctrl(gpio) = function_pio0;
      if ((pins.inputs() & bit) != 0) {
        gpio_pad(gpio) = pad_input | pad_4_ma | pad_pull_up | pad_schmitt;
        gpio_ctrl(gpio) = function_sio;
      }
      if ((pins.switched() & bit) != 0) gpio_ctrl(gpio) = function_sio;
    }
    if (pins.line_in != no_gpio) {
      // A line that is not connected must not look like one that says something.
      gpio_pad(pins.line_in) = pad_input | pad_4_ma | pad_pull_up | pad_schmitt;
      gpio_ctrl(pins.line_out) = function_uart;
      gpio_ctrl(pins.line_in) = function_uart;
    }
    enable_motors(false);
    GpioEnableSet::write(pins.switched());
    // PWM of 7.8 kHz: 128 MHz / 64 / 256.
    pwm(slice, pwm_div) = 64U << 4;
    pwm(slice, pwm_top) = 255;
    pwm(slice, pwm_cc) = 0;
    pwm(slice, pwm_csr) = 1;
    gpio_ctrl(pins.spindle_pwm) = function_pwm;
    SpindleCounter::prepare();
  }

  static void enable_motors(bool on) { set(pins.enable, !on); }
  static void switch_outputs(const BoardOutputs& outputs) {
    set(pins.spindle_direction, (outputs.switches & spindle_reverse) != 0);
    set(pins.mist, (outputs.switches & mist_on) != 0);
    set(pins.flood, (outputs.switches & flood_on) != 0);
    const bool turns = (outputs.switches & spindle_on) != 0;
    set_duty(turns ? static_cast<uint32_t>(outputs.spindle_rpm) * (256 * 65536 / full_rpm + 1) >> 16 : 0);
  }
  // Switches these outputs off at rest, and tells whether one was on.
  static bool switch_off(uint8_t switches) {
    bool was_on = false;
    if ((switches & spindle_on) != 0) {
      was_on = pwm(slice, pwm_cc) != 0;
      set_duty(0);
    }
    if ((switches & mist_on) != 0 && switch_off_pin(pins.mist)) was_on = true;
    if ((switches & flood_on) != 0 && switch_off_pin(pins.flood)) was_on = true;
    return was_on;
  }
  // Bits of BoardInput, set where a switch is closed.
  static uint16_t inputs() {
    const uint32_t low = ~GpioIn::read();
    uint32_t on = 0;
    for (uint32_t i = 0; i < pico_limits; ++i) {
      if ((low & gpio_bit(pins.limits[i])) != 0) on |= static_cast<uint32_t>(input_limit) << i;
    }
    if ((low & gpio_bit(pins.probe)) != 0) on |= input_probe;
    if ((low & gpio_bit(pins.emergency_stop)) != 0) on |= input_emergency_stop;
    if ((low & gpio_bit(pins.feed_hold)) != 0) on |= input_hold;
    if ((low & gpio_bit(pins.cycle_start)) != 0) on |= input_start;
    return static_cast<uint16_t>(on);
  }

  // From now on the interrupt is told of the pins in `stopping` when they close, and of the one in `watched` when it
  // leaves the state `closed`. Both are bits of BoardInput. While an axis is homed, other axes may still be on their
  // switches: those that are closed do not count.
  static void watch(uint16_t stopping, uint16_t watched, bool closed) {
    if ((watched & input_probe) == 0) stopping &= static_cast<uint16_t>(~(inputs() & all_limits));
    interrupts_off();
    stops_ = 0;
    watched_ = 0;
    for (uint32_t i = 0; i < pico_limits; ++i) listen(pins.limits[i], input_limit << i, stopping, watched, closed);
    listen(pins.emergency_stop, input_emergency_stop, stopping, watched, closed);
    listen(pins.probe, input_probe, stopping, watched, closed);
    SpindleCounter::listen();
    interrupts_on();
  }
  // Whether a pin that stops is closed, since whenever.
  static bool stops() { return (~GpioIn::read() & stops_) != 0; }
  // The interrupt of the pins.
  [[gnu::always_inline]] static void switch_moved() {
    const uint32_t low = ~GpioIn::read();
    if ((low & stops_) != 0 && !StepStream::dry()) PicoPlayer::halt();
    if (watched_ != 0 && ((low & watched_) != 0) != was_closed_) PicoPlayer::capture();
    SpindleCounter::index_moved();
    forget_edges();
  }

 private:
  // The spindle's speed at full duty.
  static constexpr uint32_t full_rpm = 24'000;
  static constexpr uint16_t all_limits = 0xff;
  static constexpr uint32_t slice = pins.spindle_pwm / 2 % 8;

  static void set(uint8_t gpio, bool high) {
    if (high) {
      GpioOutSet::write(gpio_bit(gpio));
    } else {
      GpioOutClear::write(gpio_bit(gpio));
    }
  }
  static bool switch_off_pin(uint8_t gpio) {
    if ((GpioOut::read() & gpio_bit(gpio)) == 0) return false;
    set(gpio, false);
    return true;
  }
  static void set_duty(uint32_t duty) {
    const uint32_t level = duty > 256 ? 256 : duty;
    pwm(slice, pwm_cc) = (pins.spindle_pwm & 1) != 0 ? level << 16 : level;
  }
  static void listen(uint8_t gpio, unsigned input, uint16_t stopping, uint16_t watched, bool closed) {
    if (gpio == no_gpio) return;
    uint32_t edges = 0;
    if ((watched & input) != 0) {
      watched_ = gpio_bit(gpio);
      was_closed_ = closed;
      edges = edge_low | edge_high;
    } else if ((stopping & input) != 0) {
      stops_ = stops_ | gpio_bit(gpio);
      edges = edge_low;
    }
    gpio_edges(gpio) = edge_bits(gpio, edge_low | edge_high);
    gpio_interrupts(gpio) = (gpio_interrupts(gpio) & ~edge_bits(gpio, 15)) | edge_bits(gpio, edges);
  }
  [[gnu::always_inline]] static void forget_edges() {
    for (uint32_t gpio = 0; gpio < gpio_count; gpio += 8) gpio_edges(gpio) = 0xcccccccc;
  }

  static inline volatile uint32_t stops_ = 0;
  static inline volatile uint32_t watched_ = 0;
  static inline volatile bool was_closed_ = false;
};

}  // namespace passo::chip
