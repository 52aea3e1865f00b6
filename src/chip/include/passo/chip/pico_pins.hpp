// PicoPins: what each GPIO of an RP2040 is for, as data that is checked at compile time.
//
// A state machine of the PIO sets all step and direction pins by one word. So these pins lie within sixteen neighbours,
// from `first` on; between them may lie pins with other jobs. Portable.
#pragma once

#include <stdint.h>

namespace passo {

inline constexpr uint8_t no_gpio = 0xff;
inline constexpr uint8_t gpio_count = 30;
inline constexpr uint8_t pico_limits = 3;

// The bit of a GPIO in the registers that have one for each; 0 if there is no such pin.
constexpr uint32_t gpio_bit(uint8_t gpio) {
  return gpio < gpio_count ? uint32_t{1} << gpio : 0;
}

struct PicoMotor {
  uint8_t step = no_gpio;
  uint8_t direction = no_gpio;
};

template <uint8_t motor_count>
struct PicoPins {
  static constexpr uint8_t motors = motor_count;
  static constexpr uint8_t window = 16;
  uint8_t first = 0;
  PicoMotor motor[motor_count] = {};
  uint8_t enable = no_gpio;  // low: the drivers are on
  uint8_t limits[pico_limits] = {no_gpio, no_gpio, no_gpio};
  uint8_t probe = no_gpio;
  uint8_t emergency_stop = no_gpio;
  uint8_t feed_hold = no_gpio;
  uint8_t cycle_start = no_gpio;
  uint8_t spindle_pwm = no_gpio;
  uint8_t spindle_direction = no_gpio;
  uint8_t mist = no_gpio;
  uint8_t flood = no_gpio;
  uint8_t line_out = no_gpio;
  uint8_t line_in = no_gpio;

  // Bits of the step or direction pins of `which` motors in a word for the state machine.
  constexpr uint16_t steps_of(uint8_t which) const {
    uint32_t bits = 0;
    for (uint8_t m = 0; m < motor_count; ++m) {
      if ((which >> m & 1) != 0) bits |= gpio_bit(motor[m].step) >> first;
    }
    return static_cast<uint16_t>(bits);
  }
  constexpr uint16_t directions_of(uint8_t which) const {
    uint32_t bits = 0;
    for (uint8_t m = 0; m < motor_count; ++m) {
      if ((which >> m & 1) != 0) bits |= gpio_bit(motor[m].direction) >> first;
    }
    return static_cast<uint16_t>(bits);
  }
  // As bits of GPIOs: the step and direction pins, and the inputs. All inputs have pull-ups: a switch connects to
  // ground.
  constexpr uint32_t motor_pins() const { return (uint32_t{steps_of(0xff)} | uint32_t{directions_of(0xff)}) << first; }
  constexpr uint32_t inputs() const {
    uint32_t bits = gpio_bit(probe) | gpio_bit(emergency_stop) | gpio_bit(feed_hold) | gpio_bit(cycle_start);
    for (const uint8_t limit : limits) bits |= gpio_bit(limit);
    return bits;
  }
  // Outputs that are on or off.
  constexpr uint32_t switched() const {
    return gpio_bit(enable) | gpio_bit(spindle_direction) | gpio_bit(mist) | gpio_bit(flood);
  }

  // Whether every motor has its pins within the window, and no pin has two jobs.
  constexpr bool is_sound() const {
    uint32_t taken = 0;
    bool sound = true;
    const auto take = [&](uint8_t gpio) {
      if (gpio == no_gpio) return;
      sound = sound && gpio < gpio_count && (taken & gpio_bit(gpio)) == 0;
      taken |= gpio_bit(gpio);
    };
    for (const PicoMotor& one : motor) {
      const uint8_t both[] = {one.step, one.direction};
      for (const uint8_t gpio : both) {
        sound = sound && gpio >= first && gpio < first + window;
        take(gpio);
      }
    }
    for (const uint8_t limit : limits) take(limit);
    const uint8_t others[] = {enable, probe, emergency_stop, feed_hold, cycle_start, spindle_pwm, spindle_direction,
                              mist,   flood, line_out,       line_in};
    for (const uint8_t gpio : others) take(gpio);
    return sound;
  }
};

// A bare Raspberry Pi Pico on a breadboard: six drivers, three limit switches.
inline constexpr PicoPins<6> pico_bare = {
    .first = 2,
    .motor = {{2, 3}, {4, 5}, {6, 7}, {8, 9}, {10, 11}, {12, 13}},
    .enable = 14,
    .limits = {19, 20, 21},
    .probe = 26,
    .emergency_stop = 22,
    .feed_hold = 27,
    .cycle_start = 28,
    .spindle_pwm = 15,
    .spindle_direction = 16,
    .mist = 18,
    .flood = 17,
    .line_out = 0,
    .line_in = 1,
};
static_assert(pico_bare.is_sound(), "a pin has two jobs, or a motor's pins are too far apart");

}  // namespace passo
