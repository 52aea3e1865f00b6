// The Uno's pins beside the motors': switches in, and what is switched.
#pragma once

#include "registers.hpp"
#include "step_interrupt.hpp"

#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

class UnoWiring {
 public:
  static void prepare() {
    PortB::output(enable | pins.spindle_pwm.mask() | pins.spindle_direction.mask());
    PortB::set(enable, true);  // drivers off
    PortB::set(limits, true);  // pull-ups: a switch connects to ground
    PortC::output(pins.mist.mask() | pins.flood.mask());
    PortC::set(stops | buttons | pins.probe.mask(), true);
    PortD::output(pins.steps_on('D') | pins.directions_on('D'));
    // PWM of 7.8 kHz at the spindle's pin, off at first.
    Ocr2a::write(0);
    Tccr2a::write(1 << 7 | 1 << 1 | 1 << 0);
    Tccr2b::write(1 << 1);
    // The interrupt looks at these flags before every step. No interrupt of their own is enabled.
    stop_low_b = limits;
    stop_low_c = stops;
    Pcmsk0::write(limits);
    Pcmsk1::write(static_cast<uint8_t>(stops | pins.probe.mask()));
    Pcifr::write(7);
  }

  static void enable_motors(bool on) { PortB::set(enable, !on); }

  static void switch_outputs(const BoardOutputs& outputs) {
    PortB::set(pins.spindle_direction.mask(), (outputs.switches & spindle_reverse) != 0);
    PortC::set(pins.mist.mask(), (outputs.switches & mist_on) != 0);
    PortC::set(pins.flood.mask(), (outputs.switches & flood_on) != 0);
    Ocr2a::write((outputs.switches & spindle_on) != 0 ? duty(outputs.spindle_rpm) : uint8_t{0});
  }

  // Bits of BoardInput, set where a switch is closed.
  static uint16_t inputs() {
    const uint8_t b = static_cast<uint8_t>(~PortB::pins());
    const uint8_t c = static_cast<uint8_t>(~PortC::pins());
    uint16_t on = 0;
    for (uint8_t m = 0; m < pins.motors; ++m) {
      if ((b & pins.limits[m].mask()) != 0) on |= static_cast<uint16_t>(input_limit << m);
    }
    if ((c & pins.probe.mask()) != 0) on |= input_probe;
    if ((c & pins.emergency_stop.mask()) != 0) on |= input_emergency_stop;
    if ((c & pins.feed_hold.mask()) != 0) on |= input_hold;
    if ((c & pins.cycle_start.mask()) != 0) on |= input_start;
    return on;
  }

  static constexpr uint8_t probe = uno_cnc_shield.probe.mask();

 private:
  static constexpr const PinMap<3>& pins = uno_cnc_shield;
  static constexpr uint8_t enable = pins.motor[0].enable.mask();
  static constexpr uint8_t limits = pins.limits[0].mask() | pins.limits[1].mask() | pins.limits[2].mask();
  static constexpr uint8_t stops = pins.emergency_stop.mask();
  static constexpr uint8_t buttons = pins.feed_hold.mask() | pins.cycle_start.mask();
  // The speed at full duty.
  static constexpr uint32_t full_rpm = 24'000;

  static uint8_t duty(uint16_t rpm) {
    const uint32_t duty = static_cast<uint32_t>(rpm) * (255 * 65536 / full_rpm + 1) >> 16;
    return duty > 255 ? uint8_t{255} : static_cast<uint8_t>(duty);
  }

  using PortB = Port<0x23>;
  using PortC = Port<0x26>;
  using PortD = Port<0x29>;
};

}  // namespace passo::chip
