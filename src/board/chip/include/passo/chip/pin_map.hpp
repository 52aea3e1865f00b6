// PinMap: what each pin of the chip is for, as data that is checked at compile time.
//
// The step timer's interrupt writes a port's toggle register (PINx). A one there toggles the pin and leaves its
// neighbours alone, so a step is two writes of the same byte. The checks follow from that: step and direction pins lie
// on the step ports. The flag bits of each step port, which mark all but plain events for the interrupt, belong to no
// motor.
//
// Alternatively the board switches the motors' windings itself. Each motor then has four pins for them, anywhere on the
// step ports; each step toggles those that change, and the flags have a byte of their own. Portable.
#pragma once

#include <stdint.h>

#include "passo/chip/pin.hpp"
#include "passo/firmware/jog_ramp.hpp"
#include "passo/firmware/keypad.hpp"
#include "passo/firmware/winding_table.hpp"

namespace passo {

inline constexpr uint8_t winding_count = 4;

struct MotorPins {
  Pin step = {};
  Pin direction = {};
  Pin enable = {};                      // active low: the driver is on. Several motors may share one pin
  Pin windings[winding_count] = {};     // instead of the three above: F1 to F4 of WindingTable
  DriveMode drive = DriveMode::two_on;  // how the windings are switched

  // Returns the motor's pins on `port` that carry current in a pattern.
  constexpr uint8_t winding_bits(char port, uint8_t pattern = 0x0f) const {
    uint8_t bits = 0;
    for (uint8_t f = 0; f < winding_count; ++f) {
      if ((pattern >> f & 1) != 0 && windings[f].port == port) bits = static_cast<uint8_t>(bits | windings[f].mask());
    }
    return bits;
  }
};

// For moving the machine by hand (ManualMode). Either all of these pins exist, or none. Any pins are allowed.
struct KeypadPins {
  Pin rows[keypad_rows] = {};  // 123, 456, 789, *0#
  Pin columns[keypad_columns] = {};
  Pin tool_button = {};
  Pin automatic_indicator = {};
  Pin manual_indicator = {};
  JogSpeeds speeds = {};

  constexpr bool exists() const { return rows[0].exists(); }
  template <class Visit>
  constexpr void each(Visit visit) const {
    each_input(visit);
    for (const Pin pin : columns) visit(pin);
    visit(automatic_indicator);
    visit(manual_indicator);
  }
  template <class Visit>
  constexpr void each_input(Visit visit) const {
    for (const Pin pin : rows) visit(pin);
    visit(tool_button);
  }
  constexpr bool is_whole() const {
    bool whole = true;
    each([&](Pin pin) { whole = whole && pin.exists(); });
    return whole;
  }
};

// A spindle encoder: its pulses on the pin that clocks a timer, its index on an input capture pin. Either both exist,
// or neither.
struct EncoderPins {
  Pin pulses = {};
  Pin index = {};

  constexpr bool exists() const { return pulses.exists(); }
  constexpr bool is_whole() const { return pulses.exists() == index.exists(); }
};

inline constexpr uint8_t most_step_ports = 4;
inline constexpr uint8_t most_axis_switches = 6;

template <uint8_t motor_count>
struct PinMap {
  static constexpr uint8_t motors = motor_count;
  MotorPins motor[motor_count] = {};
  // The ports with step or direction pins, the first one with the interrupt's flags; or the ports with windings.
  char step_ports[most_step_ports] = {};
  uint8_t flag_special = 0;  // masks in the first step port
  uint8_t flag_stop = 0;

  Pin limits[most_axis_switches] = {};  // limit switches 0 to 5, as BoardInput numbers them
  Pin probe = {};
  Pin emergency_stop = {};
  Pin door = {};
  Pin feed_hold = {};
  Pin cycle_start = {};

  Pin spindle_pwm = {};
  Pin spindle_direction = {};
  Pin spindle_relay = {};  // for a tool that is only switched on or off
  Pin mist = {};
  Pin flood = {};

  KeypadPins keypad = {};
  EncoderPins encoder = {};

  constexpr bool drives_windings() const { return motor[0].windings[0].exists(); }

  // The motors' pins of one kind on one step port, for the motors in `which`.
  constexpr uint8_t steps_on(char port, uint8_t which = 0xff) const {
    uint8_t mask = 0;
    for (uint8_t m = 0; m < motor_count; ++m) {
      if ((which >> m & 1) != 0 && motor[m].step.port == port) mask = static_cast<uint8_t>(mask | motor[m].step.mask());
    }
    return mask;
  }
  constexpr uint8_t directions_on(char port, uint8_t which = 0xff) const {
    uint8_t mask = 0;
    for (uint8_t m = 0; m < motor_count; ++m) {
      const Pin pin = motor[m].direction;
      if ((which >> m & 1) != 0 && pin.port == port) mask = static_cast<uint8_t>(mask | pin.mask());
    }
    return mask;
  }

  // The pins of one kind on a port. All inputs have pull-ups: a switch connects to ground.
  constexpr uint8_t enables_on(char port) const {
    uint8_t mask = 0;
    for (const MotorPins& one : motor)
      mask = static_cast<uint8_t>(mask | (one.enable.port == port ? one.enable.mask() : 0));
    return mask;
  }
  constexpr uint8_t limits_on(char port) const {
    uint8_t mask = 0;
    for (const Pin one : limits) mask = static_cast<uint8_t>(mask | (one.port == port ? one.mask() : 0));
    return mask;
  }
  // Inputs that stop the machine at once.
  constexpr uint8_t stops_on(char port) const {
    return static_cast<uint8_t>(limits_on(port) | (emergency_stop.port == port ? emergency_stop.mask() : 0));
  }
  // The same, with the buttons that a host may configure as drive alarms.
  constexpr uint8_t may_stop_on(char port) const {
    const Pin buttons[] = {feed_hold, cycle_start};
    uint8_t mask = stops_on(port);
    for (const Pin one : buttons) mask = static_cast<uint8_t>(mask | (one.port == port ? one.mask() : 0));
    return mask;
  }
  constexpr uint8_t inputs_on(char port) const {
    const Pin others[] = {probe, door, feed_hold, cycle_start, encoder.pulses, encoder.index};
    uint8_t mask = stops_on(port);
    for (const Pin one : others) mask = static_cast<uint8_t>(mask | (one.port == port ? one.mask() : 0));
    keypad.each_input([&](Pin one) { mask = static_cast<uint8_t>(mask | (one.port == port ? one.mask() : 0)); });
    return mask;
  }
  // Outputs that are switched in step with the motion.
  constexpr uint8_t switched_on(char port) const {
    const Pin all[] = {spindle_pwm, spindle_direction, spindle_relay, mist, flood};
    uint8_t mask = 0;
    for (const Pin one : all) mask = static_cast<uint8_t>(mask | (one.port == port ? one.mask() : 0));
    return mask;
  }
  constexpr uint8_t windings_on(char port) const {
    uint8_t mask = 0;
    for (const MotorPins& one : motor) mask = static_cast<uint8_t>(mask | one.winding_bits(port));
    return mask;
  }
  constexpr uint8_t outputs_on(char port) const {
    const Pin indicators[] = {keypad.automatic_indicator, keypad.manual_indicator};
    uint8_t mask = static_cast<uint8_t>(steps_on(port) | directions_on(port) | enables_on(port) | windings_on(port) |
                                        switched_on(port));
    for (const Pin one : indicators) mask = static_cast<uint8_t>(mask | (one.port == port ? one.mask() : 0));
    return mask;
  }

  // Whether no pin has two functions. Only enable pins may be shared, between motors.
  constexpr bool without_conflict() const {
    constexpr uint8_t most = (2 + winding_count) * motor_count + most_axis_switches + 10 + 10 + 2;
    Pin pins[most] = {};
    uint8_t count = 0;
    for (const MotorPins& one : motor) {
      pins[count++] = one.step;
      pins[count++] = one.direction;
      for (const Pin winding : one.windings) pins[count++] = winding;
    }
    for (const Pin one : limits) pins[count++] = one;
    const Pin others[] = {probe,       emergency_stop,    door,          feed_hold, cycle_start,
                          spindle_pwm, spindle_direction, spindle_relay, mist,      flood};
    for (const Pin one : others) pins[count++] = one;
    keypad.each([&](Pin one) { pins[count++] = one; });
    pins[count++] = encoder.pulses;
    pins[count++] = encoder.index;
    for (uint8_t a = 0; a < most; ++a) {
      if (!pins[a].exists()) continue;
      for (uint8_t b = 0; b < a; ++b) {
        if (pins[a] == pins[b]) return false;
      }
      for (const MotorPins& one : motor) {
        if (pins[a] == one.enable) return false;
      }
    }
    return true;
  }

  constexpr uint8_t ports() const {
    uint8_t count = 0;
    while (count < most_step_ports && step_ports[count] != 0) ++count;
    return count;
  }
  constexpr bool has_step_port(char port) const {
    for (const char one : step_ports) {
      if (one != 0 && one == port) return true;
    }
    return false;
  }
  // Whether the keypad is complete, and the chip's timer can count its speeds.
  constexpr bool has_whole_keypad(uint32_t clock) const { return keypad.is_whole() && can_ramp(keypad.speeds, clock); }
  constexpr bool fits_the_interrupt() const {
    // The interrupt writes the step ports as a whole.
    for (const char port : step_ports) {
      if (port != 0 && switched_on(port) != 0) return false;
    }
    return drives_windings() ? has_all_windings() : has_all_steps();
  }

 private:
  constexpr bool has_all_windings() const {
    for (const MotorPins& pins : motor) {
      if (pins.step.exists() || pins.direction.exists() || pins.enable.exists()) return false;
      for (const Pin winding : pins.windings) {
        if (!has_step_port(winding.port)) return false;
      }
    }
    return true;
  }
  constexpr bool has_all_steps() const {
    for (const MotorPins& pins : motor) {
      if (!has_step_port(pins.step.port) || !has_step_port(pins.direction.port)) return false;
    }
    const uint8_t flags = static_cast<uint8_t>(flag_special | flag_stop);
    const uint8_t taken = static_cast<uint8_t>(steps_on(step_ports[0]) | directions_on(step_ports[0]));
    return flag_special != 0 && flag_stop != 0 && (flag_special & flag_stop) == 0 && (flags & taken) == 0;
  }
};

// Returns the same board with an individual drive mode for each motor.
template <uint8_t motor_count>
constexpr PinMap<motor_count> driven(PinMap<motor_count> pins, const DriveMode (&drives)[motor_count]) {
  for (uint8_t m = 0; m < motor_count; ++m) pins.motor[m].drive = drives[m];
  return pins;
}

// The pins of each set of motors on one port, computed at compile time.
template <uint8_t motor_count>
struct MotorPinSets {
  uint8_t steps[1 << motor_count] = {};
  uint8_t directions[1 << motor_count] = {};
};

template <uint8_t motor_count>
constexpr MotorPinSets<motor_count> motor_pin_sets(const PinMap<motor_count>& pins, char port) {
  MotorPinSets<motor_count> sets;
  for (uint8_t motors = 0; motors < 1 << motor_count; ++motors) {
    sets.steps[motors] = pins.steps_on(port, motors);
    sets.directions[motors] = pins.directions_on(port, motors);
  }
  return sets;
}

template <uint8_t motor_count, uint8_t port_count>
struct MotorPinsByPort {
  MotorPinSets<motor_count> on[port_count];
};
// In the order of the map's step ports.
template <uint8_t port_count, uint8_t motor_count>
constexpr MotorPinsByPort<motor_count, port_count> motor_pins_by_port(const PinMap<motor_count>& pins) {
  MotorPinsByPort<motor_count, port_count> all;
  for (uint8_t p = 0; p < port_count; ++p) all.on[p] = motor_pin_sets(pins, pins.step_ports[p]);
  return all;
}

}  // namespace passo
