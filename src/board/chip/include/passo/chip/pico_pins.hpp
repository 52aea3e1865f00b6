// PicoPins: what each GPIO of an RP2040 is for, as data that is checked at compile time.
//
// A PIO state machine sets all step and direction pins with one word. So these pins lie within sixteen consecutive
// GPIOs, from `first` on; pins with other functions may lie between them. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/handwheel_count.hpp"

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

// A handwheel: its two lines, and its selectors. Either all of these pins exist, or none.
struct PicoHandwheel {
  uint8_t a = no_gpio;
  uint8_t b = no_gpio;
  uint8_t axes[handwheel_axes] = {no_gpio, no_gpio, no_gpio, no_gpio};
  uint8_t tenfold = no_gpio;
  uint8_t hundredfold = no_gpio;
};

struct PicoPins {
  static constexpr uint8_t most_motors = 8;
  static constexpr uint8_t window = 16;
  uint8_t motors = 0;
  uint8_t first = 0;
  PicoMotor motor[most_motors] = {};
  uint8_t enable = no_gpio;  // active low: the drivers are on
  uint8_t limits[pico_limits] = {no_gpio, no_gpio, no_gpio};
  uint8_t probe = no_gpio;
  uint8_t emergency_stop = no_gpio;
  uint8_t feed_hold = no_gpio;
  uint8_t cycle_start = no_gpio;
  uint8_t spindle_pwm = no_gpio;
  uint8_t spindle_direction = no_gpio;
  uint8_t mist = no_gpio;
  uint8_t flood = no_gpio;
  // The spindle encoder. A PWM slice counts the pulses. Only the slice's second pin can do this, so the GPIO number is
  // odd.
  uint8_t encoder_pulses = no_gpio;
  uint8_t encoder_index = no_gpio;
  PicoHandwheel wheel = {};
  // A serial port in addition to USB.
  uint8_t line_out = no_gpio;
  uint8_t line_in = no_gpio;

  // Bits of the step or direction pins of the motors in `which`, in a word for the state machine.
  constexpr uint16_t steps_of(uint8_t which) const {
    uint32_t bits = 0;
    for (uint8_t m = 0; m < motors; ++m) {
      if ((which >> m & 1) != 0) bits |= gpio_bit(motor[m].step) >> first;
    }
    return static_cast<uint16_t>(bits);
  }
  constexpr uint16_t directions_of(uint8_t which) const {
    uint32_t bits = 0;
    for (uint8_t m = 0; m < motors; ++m) {
      if ((which >> m & 1) != 0) bits |= gpio_bit(motor[m].direction) >> first;
    }
    return static_cast<uint16_t>(bits);
  }
  // As GPIO bits: the step and direction pins, and the inputs. All inputs have pull-ups: a switch connects to ground.
  constexpr uint32_t motor_pins() const { return (uint32_t{steps_of(0xff)} | uint32_t{directions_of(0xff)}) << first; }
  constexpr uint32_t inputs() const {
    uint32_t bits = gpio_bit(probe) | gpio_bit(emergency_stop) | gpio_bit(feed_hold) | gpio_bit(cycle_start) |
                    gpio_bit(encoder_pulses) | gpio_bit(encoder_index) | gpio_bit(wheel.a) | gpio_bit(wheel.b) |
                    gpio_bit(wheel.tenfold) | gpio_bit(wheel.hundredfold);
    for (const uint8_t limit : limits) bits |= gpio_bit(limit);
    for (const uint8_t axis : wheel.axes) bits |= gpio_bit(axis);
    return bits;
  }
  // Outputs that are on or off.
  constexpr uint32_t switched() const {
    return gpio_bit(enable) | gpio_bit(spindle_direction) | gpio_bit(mist) | gpio_bit(flood);
  }

  static constexpr uint8_t slice_of(uint8_t gpio) { return gpio / 2 % 8; }
  constexpr bool has_encoder() const { return encoder_pulses != no_gpio; }
  constexpr bool has_handwheel() const { return wheel.a != no_gpio; }
  // One register has the edges of eight pins: an interrupt reads both lines there.
  constexpr bool has_whole_handwheel() const {
    bool whole = wheel.b != no_gpio && wheel.tenfold != no_gpio && wheel.hundredfold != no_gpio;
    for (const uint8_t axis : wheel.axes) whole = whole && axis != no_gpio;
    return whole && wheel.a / 8 == wheel.b / 8;
  }

  // Whether every motor has its pins within the window, and no pin has two functions.
  constexpr bool is_sound() const {
    uint32_t taken = 0;
    bool sound = true;
    const auto take = [&](uint8_t gpio) {
      if (gpio == no_gpio) return;
      sound = sound && gpio < gpio_count && (taken & gpio_bit(gpio)) == 0;
      taken |= gpio_bit(gpio);
    };
    sound = motors <= most_motors;
    for (uint8_t m = 0; m < motors && m < most_motors; ++m) {
      const uint8_t both[] = {motor[m].step, motor[m].direction};
      for (const uint8_t gpio : both) {
        sound = sound && gpio >= first && gpio < first + window;
        take(gpio);
      }
    }
    for (const uint8_t limit : limits) take(limit);
    const uint8_t others[] = {enable,         probe,   emergency_stop, feed_hold,         cycle_start,      spindle_pwm,
                              mist,           flood,   line_out,       spindle_direction, encoder_index,    line_in,
                              encoder_pulses, wheel.a, wheel.b,        wheel.tenfold,     wheel.hundredfold};
    for (const uint8_t gpio : others) take(gpio);
    for (const uint8_t gpio : wheel.axes) take(gpio);
    if (has_handwheel()) sound = sound && has_whole_handwheel();
    if (encoder_pulses != no_gpio) {
      const bool slice_is_free = spindle_pwm == no_gpio || slice_of(spindle_pwm) != slice_of(encoder_pulses);
      sound = sound && (encoder_pulses & 1) != 0 && encoder_index != no_gpio && slice_is_free;
    }
    return sound;
  }
};

// A bare Raspberry Pi Pico on a breadboard: six drivers, three limit switches.
inline constexpr PicoPins pico_bare = {
    .motors = 6,
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

// The same with a spindle encoder on the pins of the serial port.
constexpr PicoPins with_encoder(PicoPins pins) {
  pins.encoder_pulses = pins.line_in;
  pins.encoder_index = pins.line_out;
  pins.line_in = pins.line_out = no_gpio;
  return pins;
}
inline constexpr PicoPins pico_lathe = with_encoder(pico_bare);

// The same with a handwheel on the pins of the serial port, of two motors, of the spindle's direction and of mist.
constexpr PicoPins with_handwheel(PicoPins pins) {
  pins.wheel.a = pins.motor[4].step;
  pins.wheel.b = pins.motor[4].direction;
  pins.wheel.axes[0] = pins.motor[5].step;
  pins.wheel.axes[1] = pins.motor[5].direction;
  pins.wheel.axes[2] = pins.line_out;
  pins.wheel.axes[3] = pins.line_in;
  pins.wheel.tenfold = pins.spindle_direction;
  pins.wheel.hundredfold = pins.mist;
  pins.motors = 4;
  pins.motor[4] = pins.motor[5] = {};
  pins.line_in = pins.line_out = pins.spindle_direction = pins.mist = no_gpio;
  return pins;
}
inline constexpr PicoPins pico_mpg = with_handwheel(pico_bare);

// Eight drivers use all but ten pins: no serial port in addition to USB, and no buttons.
inline constexpr PicoPins pico_eight = {
    .motors = 8,
    .first = 0,
    .motor = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {8, 9}, {10, 11}, {12, 13}, {14, 15}},
    .enable = 16,
    .limits = {19, 20, 21},
    .probe = 26,
    .emergency_stop = 22,
    .spindle_pwm = 17,
    .spindle_direction = 18,
    .mist = 28,
    .flood = 27,
};

// A Pico on the carrier PicoBOB (Expatria Technologies) drives a breakout board made for a parallel port. Its inputs
// are three switches, probe and emergency stop. Source of the wiring: grblHAL, boards/picobob_map.h.
inline constexpr PicoPins picobob = {
    .motors = 5,
    .first = 9,
    .motor = {{17, 9}, {18, 10}, {19, 11}, {20, 12}, {21, 13}},
    .limits = {2, 1, 5},
    .probe = 4,
    .emergency_stop = 3,
    .spindle_pwm = 14,
    .flood = 16,
};
static_assert(pico_bare.is_sound() && pico_lathe.is_sound() && pico_mpg.is_sound() && pico_eight.is_sound() &&
                  picobob.is_sound(),
              "a pin has two jobs, a motor's pins are too far apart, or an encoder's cannot count");

// The board's name. Its image is named motion_ plus this name.
struct PicoBoardPins {
  const char* name;
  const PicoPins& pins;
};
inline constexpr PicoBoardPins pico_boards[] = {{"pico", pico_bare},
                                                {"pico_lathe", pico_lathe},
                                                {"pico_mpg", pico_mpg},
                                                {"pico_eight", pico_eight},
                                                {"picobob", picobob}};

}  // namespace passo
