// PicoWiring: all pins except the motors', taken from the pin map: switches and outputs.
#pragma once

#include "handwheel_counter.hpp"
#include "pico_player.hpp"
#include "registers.hpp"
#include "spindle_counter.hpp"

#include "passo/wire/message.hpp"

namespace passo::chip {

// The pin of an input.
struct PicoInput {
  uint8_t gpio;
  uint16_t which;
};
inline constexpr PicoInput pico_inputs[] = {
    {pins.limits[0], input_limit << 0}, {pins.limits[1], input_limit << 1},          {pins.limits[2], input_limit << 2},
    {pins.probe, input_probe},          {pins.emergency_stop, input_emergency_stop}, {pins.feed_hold, input_hold},
    {pins.cycle_start, input_start}};

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
      // An unconnected receive pin must not look like one that receives data.
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
    HandwheelCounter::prepare();
  }

  // Sets the pin levels that a host specifies, for the pins that exist. Returns the levels set. Call only at
  // standstill.
  //
  // The chip itself inverts an output, between its peripheral and its pad. So the inversion is invisible to the state
  // machine, the PWM and any value read back.
  static PinSetup set_up(const PinSetup& wanted) {
    PinSetup done;
    on_when_high_ = 0;
    for (const PicoInput& input : pico_inputs) {
      if (input.gpio == no_gpio || (wanted.inputs & input.which) == 0) continue;
      on_when_high_ = on_when_high_ | gpio_bit(input.gpio);
      done.inputs |= input.which;
    }
    done.steps = wanted.steps & PicoPinTables::all;
    done.drivers_rest = drivers_rest_ = wanted.drivers_rest;
    done.alarms =
        wanted.alarms & inputs_of(pins.inputs()) & static_cast<uint16_t>(~(input_probe | input_emergency_stop));
    alarms_ = done.alarms;
    done.filter = wanted.filter;
    filter_ = wanted.filter;
    constexpr struct {
      uint8_t gpio;
      uint8_t which;
    } outputs[] = {{pins.spindle_pwm, spindle_on},
                   {pins.spindle_direction, spindle_reverse},
                   {pins.mist, mist_on},
                   {pins.flood, flood_on},
                   {pins.enable, inverted_enable}};
    for (const auto& output : outputs) {
      if (output.gpio != no_gpio) done.outputs |= wanted.outputs & output.which;
    }
    if (done.outputs != inverted_outputs_) switch_outputs({});
    inverted_outputs_ = done.outputs;
    for (const auto& output : outputs) invert(output.gpio, (done.outputs & output.which) != 0);
    for (uint32_t m = 0; m < pins.motors; ++m) invert(pins.motor[m].step, (done.steps >> m & 1) != 0);
    return done;
  }
  static uint8_t drivers_rest() { return drivers_rest_; }
  // Microseconds for which a switch must stay in its new state.
  static uint8_t filter() { return filter_; }
  // Inputs that are drive alarms.
  static uint16_t alarms() { return alarms_; }
  static uint8_t microseconds() { return TimerLow::read() & 0x7f; }
  static void breathe() {}
  // Any switches can be watched together.
  static bool can_watch(uint8_t limits) {
    for (uint32_t i = 0; i < pico_limits; ++i) {
      if (pins.limits[i] != no_gpio) limits &= static_cast<uint8_t>(~(1U << i));
    }
    return limits == 0;
  }

  static void enable_motors(bool on) { set(pins.enable, !on); }
  static void switch_outputs(const BoardOutputs& outputs) {
    set(pins.spindle_direction, (outputs.switches & spindle_reverse) != 0);
    set(pins.mist, (outputs.switches & mist_on) != 0);
    set(pins.flood, (outputs.switches & flood_on) != 0);
    const bool turns = (outputs.switches & spindle_on) != 0;
    set_duty(turns ? static_cast<uint32_t>(outputs.spindle_rpm) * (256 * 65536 / full_rpm + 1) >> 16 : 0);
  }
  // Switches these outputs off at standstill, and returns whether one was on.
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
  // Bits of BoardInput, set where a switch is on.
  static uint16_t inputs() { return inputs_of(pins_that_are_on()); }
  // Returns the inputs that were on when the interrupt captured.
  static uint16_t captured_inputs() { return inputs_of(captured_); }

  // From now on the interrupt reacts to the pins in `stopping` when they become triggered, and to those in `watched`
  // when they leave the state `closed` (true: at least one is triggered). Both are bits of BoardInput. While an axis is
  // homed, other axes may still be on their switches: those already triggered are ignored.
  static void watch(uint16_t stopping, uint16_t watched, bool closed) {
    if ((watched & input_probe) == 0) stopping &= static_cast<uint16_t>(~(inputs() & all_limits));
    interrupts_off();
    stops_ = 0;
    watched_ = 0;
    was_closed_ = closed;
    for (const PicoInput& input : pico_inputs) listen(input, stopping, watched);
    SpindleCounter::listen();
    HandwheelCounter::listen();
    interrupts_on();
  }
  // Returns the inputs that stop the motors, as bits of BoardInput.
  static uint16_t stopping() { return inputs_of(stops_); }
  // Handles the pin interrupt.
  [[gnu::always_inline]] static void switch_moved() {
    const uint32_t on = pins_that_are_on();
    // With a filter, the main loop checks whether the switch stays triggered.
    if ((on & stops_) != 0 && filter_ == 0 && !StepStream::dry()) PicoPlayer::halt();
    if (watched_ != 0 && ((on & watched_) != 0) != was_closed_ && PicoPlayer::capture()) captured_ = on;
    SpindleCounter::index_moved();
    HandwheelCounter::moved();
    forget_edges();
  }

 private:
  // The spindle's speed at full duty.
  static constexpr uint32_t full_rpm = 24'000;
  static constexpr uint16_t all_limits = 0xff;
  static constexpr uint32_t slice = pins.spindle_pwm / 2 % 8;

  [[gnu::always_inline]] static uint32_t pins_that_are_on() { return ~GpioIn::read() ^ on_when_high_; }
  static uint16_t inputs_of(uint32_t pins_on) {
    uint32_t on = 0;
#pragma clang loop unroll(full)
    for (const PicoInput& input : pico_inputs) {
      if ((pins_on & gpio_bit(input.gpio)) != 0) on |= input.which;
    }
    return static_cast<uint16_t>(on);
  }
  static void invert(uint8_t gpio, bool inverted) {
    if (gpio == no_gpio) return;
    gpio_ctrl(gpio) = (gpio_ctrl(gpio) & ~output_inverted) | (inverted ? output_inverted : 0);
  }
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
  static void listen(const PicoInput& input, uint16_t stopping, uint16_t watched) {
    if (input.gpio == no_gpio) return;
    const uint32_t bit = gpio_bit(input.gpio);
    uint32_t edges = 0;
    if ((watched & input.which) != 0) {
      watched_ = watched_ | bit;
      edges = edge_low | edge_high;
    } else if ((stopping & input.which) != 0) {
      stops_ = stops_ | bit;
      edges = (on_when_high_ & bit) != 0 ? edge_high : edge_low;
    }
    gpio_edges(input.gpio) = edge_bits(input.gpio, edge_low | edge_high);
    gpio_interrupts(input.gpio) =
        (gpio_interrupts(input.gpio) & ~edge_bits(input.gpio, 15)) | edge_bits(input.gpio, edges);
  }
  [[gnu::always_inline]] static void forget_edges() {
    for (uint32_t gpio = 0; gpio < gpio_count; gpio += 8) {
      gpio_edges(gpio) = 0xcccccccc & ~HandwheelCounter::edges_beside(gpio);
    }
  }

  static inline volatile uint32_t stops_ = 0;
  static inline volatile uint32_t watched_ = 0;
  static inline volatile bool was_closed_ = false;
  static inline volatile uint32_t captured_ = 0;      // the pins that were on at a capture
  static inline volatile uint32_t on_when_high_ = 0;  // active-high inputs
  static inline uint8_t inverted_outputs_ = 0;        // bits of PinSetup's outputs
  static inline uint8_t drivers_rest_ = 0;
  static inline volatile uint8_t filter_ = 0;
  static inline uint16_t alarms_ = 0;
};

}  // namespace passo::chip
