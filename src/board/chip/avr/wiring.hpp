// Wiring: all pins except the motors', taken from the board's pin map: switches and switched outputs.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "serial_line.hpp"

#ifdef __AVR_ATmega2560__
#include "mega_wiring.hpp"
#else
#include "uno_wiring.hpp"
#endif

#ifdef PASSO_WINDINGS
#include "winding_pins.hpp"
#endif

#include "passo/wire/message.hpp"

namespace passo::chip {

struct PortPlan {
  char port = 0;
  uint8_t inputs = 0;  // these pins have pull-ups
  uint8_t outputs = 0;
};
struct PortPlans {
  PortPlan of[11];
  constexpr PortPlans() {
    constexpr char ports[] = "ABCDEFGHJKL";
    for (uint8_t i = 0; i < 11; ++i) of[i] = {ports[i], pins.inputs_on(ports[i]), pins.outputs_on(ports[i])};
  }
};

class Wiring {
 public:
  static void prepare() {
    set_quiet(0);
    enable_motors(false);
    prepare_ports();
    prepare_spindle();
    watch_switches();
  }

  static void enable_motors(bool on) {
#ifdef PASSO_WINDINGS
    if (!on) WindingPins::release();
#endif
    const bool high = on == is_inverted(inverted_enable);
#pragma clang loop unroll(full)
    for (const MotorPins& motor : pins.motor) set(motor.enable, high);
  }

  // Sets the pin levels that a host specifies, for the pins that exist. Returns the levels set. Call only at
  // standstill.
  [[gnu::noinline]] static PinSetup set_up(const PinSetup& wanted) {
    PinSetup done;
    done.inputs = set_quiet(wanted.inputs);
    done.outputs = wanted.outputs & known_outputs();
    done.drivers_rest = wanted.drivers_rest;
    Twar::write(wanted.drivers_rest);
    done.alarms = wanted.alarms & may_be_alarms;
    Ocr1bh::write(static_cast<uint8_t>(done.alarms >> 8));
    Ocr1bl::write(static_cast<uint8_t>(done.alarms));
    done.filter = wanted.filter;
    Ocr2b::write(wanted.filter);
    if (done.outputs == Twbr::read()) return done;
    const Pin enable = pins.motor[0].enable;
    const bool enabled = enable.exists() && is_high(enable) == is_inverted(inverted_enable);
    Twbr::write(done.outputs);
    if (enable.exists()) enable_motors(enabled);
    switch_all_off();
    return done;
  }
  static uint8_t drivers_rest() {
    return Twar::read();
  }
  // Returns for how many microseconds a switch must stay in its new state. Like other parts of the setup, the value is
  // in an otherwise unused register.
  [[gnu::always_inline]] static uint8_t filter() {
    return Ocr2b::read();
  }
  // Returns the inputs that are drive alarms. This compare register is unused too.
  [[gnu::always_inline]] static uint16_t alarms() {
    return static_cast<uint16_t>(Ocr1bl::read() | Ocr1bh::read() << 8);
  }
  // Timer 2 runs all the time.
  [[gnu::always_inline]] static uint8_t microseconds() {
    return Tcnt2::read() >> 1;
  }
  [[gnu::noinline]] static void breathe() {
    SerialLine::breathe();
  }

  // Returns the action that switches the outputs to this state and keeps all other pins of their ports.
  static OutputAction action_of(const BoardOutputs& outputs) {
    const bool turns = pins.spindle_pwm.exists() && (outputs.switches & spindle_on) != 0;
    const uint8_t duty = turns ? duty_of(outputs.spindle_rpm) : uint8_t{0};
    const uint8_t connected = is_inverted(spindle_on) ? spindle_connected | spindle_inverting : spindle_connected;
    return {.first_port = port_with(output_ports[0], outputs.switches),
            .second_port = port_with(output_ports[1], outputs.switches),
            .duty = duty,
            .control = duty != 0 ? connected : spindle_disconnected};
  }
  // Call only while the interrupt is not playing, because the interrupt applies actions too.
  [[gnu::always_inline]] static void act(const volatile OutputAction& action) {
    port_register(output_ports[0], 2) = action.first_port;
    port_register(output_ports[1], 2) = action.second_port;
    SpindleDuty::write(action.duty);
    SpindleControl::write(action.control);
  }

  // Switches these outputs off at standstill, and returns whether one was on. A spindle at speed 0 counts as off.
  [[gnu::noinline]] static bool switch_off(uint8_t switches) {
    bool was_on = false;
    if ((switches & spindle_on) != 0) {
      was_on = pins.spindle_pwm.exists() && SpindleControl::read() != spindle_disconnected;
      if (was_on) SpindleControl::write(spindle_disconnected);
      if (switch_off(pins.spindle_relay, spindle_on)) was_on = true;
    }
    if ((switches & mist_on) != 0 && switch_off(pins.mist, mist_on)) was_on = true;
    if ((switches & flood_on) != 0 && switch_off(pins.flood, flood_on)) was_on = true;
    return was_on;
  }

  // Bits of BoardInput, set where a switch is closed.
  static uint16_t inputs() {
    uint16_t on = 0;
#pragma clang loop unroll(full)
    for (uint8_t i = 0; i < most_axis_switches; ++i) {
      if (closed(pins.limits[i])) on |= static_cast<uint16_t>(input_limit << i);
    }
    if (closed(pins.probe)) on |= input_probe;
    if (closed(pins.emergency_stop)) on |= input_emergency_stop;
    if (closed(pins.feed_hold)) on |= input_hold;
    if (closed(pins.cycle_start)) on |= input_start;
    return on;
  }

  [[gnu::always_inline]] static volatile uint8_t& port_register(char port, uint8_t which) {
    return *reinterpret_cast<volatile uint8_t*>(port_registers(port) + which);
  }
  [[gnu::always_inline]] static bool closed(Pin pin) {
    return pin.exists() && (pins_that_are_on(pin.port) & pin.mask()) != 0;
  }
  // A one written to PINx toggles the pin: neighbouring pins stay unchanged, even if the interrupt comes in between.
  [[gnu::always_inline]] static void set(Pin pin, bool high) {
    if (!pin.exists()) return;
    const uint8_t now = port_register(pin.port, 2);
    port_register(pin.port, 0) = static_cast<uint8_t>((high ? ~now : now) & pin.mask());
  }

 private:
  // Bits of PinSetup's outputs. They are in an otherwise unused register, because the Uno's memory has no byte left.
  [[gnu::always_inline]] static bool is_inverted(uint8_t output) {
    return (Twbr::read() & output) != 0;
  }
  [[gnu::always_inline]] static bool is_high(Pin pin) {
    return (port_register(pin.port, 2) & pin.mask()) != 0;
  }

  [[gnu::always_inline]] static bool switch_off(Pin pin, uint8_t output) {
    if (!pin.exists() || is_high(pin) == is_inverted(output)) return false;
    set(pin, is_inverted(output));
    return true;
  }

  static constexpr uint8_t known_outputs() {
    uint8_t known = 0;
    if (pins.spindle_pwm.exists() || pins.spindle_relay.exists()) known |= spindle_on;
    if (pins.spindle_direction.exists()) known |= spindle_reverse;
    if (pins.mist.exists()) known |= mist_on;
    if (pins.flood.exists()) known |= flood_on;
    if (pins.motor[0].enable.exists()) known |= inverted_enable;
    return known;
  }
  // Sets which inputs are active high. Returns those that exist.
  [[gnu::noinline]] static uint16_t set_quiet(uint16_t inputs) {
    constexpr struct {
      Pin pin;
      uint16_t which;
    } all[] = {{pins.limits[0], input_limit << 0}, {pins.limits[1], input_limit << 1},
               {pins.limits[2], input_limit << 2}, {pins.limits[3], input_limit << 3},
               {pins.limits[4], input_limit << 4}, {pins.limits[5], input_limit << 5},
               {pins.probe, input_probe},          {pins.door, input_door},
               {pins.feed_hold, input_hold},       {pins.emergency_stop, input_emergency_stop},
               {pins.cycle_start, input_start}};
    uint16_t done = 0;
#pragma clang loop unroll(full)
    for (const char port : input_ports) {
      uint8_t levels = 0xff;
#pragma clang loop unroll(full)
      for (const auto& input : all) {
        if (input.pin.port != port || (inputs & input.which) == 0) continue;
        levels = static_cast<uint8_t>(levels & ~input.pin.mask());
        done |= input.which;
      }
      set_quiet_levels(port, levels);
    }
    return done;
  }
  [[gnu::noinline]] static void switch_all_off() {
    port_register(output_ports[0], 2) = port_with(output_ports[0], 0);
    port_register(output_ports[1], 2) = port_with(output_ports[1], 0);
    SpindleControl::write(spindle_disconnected);
  }

  // The spindle's speed at full duty.
  static constexpr uint32_t full_rpm = 24'000;

  static void prepare_ports() {
    constexpr PortPlans plans;
#pragma clang loop unroll(full)
    for (const PortPlan& plan : plans.of) {
      if (plan.inputs != 0)
        port_register(plan.port, 2) = static_cast<uint8_t>(port_register(plan.port, 2) | plan.inputs);
      if (plan.outputs != 0) port_register(plan.port, 1) = plan.outputs;
    }
  }
  [[gnu::always_inline]] static uint8_t port_with(char port, uint8_t switches) {
    constexpr struct {
      Pin pin;
      uint8_t output;
      uint8_t which;  // 0: never on
    } outputs[] = {{pins.spindle_direction, spindle_reverse, spindle_reverse},
                   {pins.spindle_relay, spindle_on, spindle_on},
                   {pins.spindle_pwm, spindle_on, 0},
                   {pins.mist, mist_on, mist_on},
                   {pins.flood, flood_on, flood_on}};
    uint8_t value = port_register(port, 2);
#pragma clang loop unroll(full)
    for (const auto& output : outputs) {
      if (output.pin.port != port) continue;
      value = static_cast<uint8_t>(value & ~output.pin.mask());
      if (((switches & output.which) != 0) != is_inverted(output.output))
        value = static_cast<uint8_t>(value | output.pin.mask());
    }
    return value;
  }
  static uint8_t duty_of(uint16_t rpm) {
    const uint32_t duty = static_cast<uint32_t>(rpm) * (255 * 65536 / full_rpm + 1) >> 16;
    return duty > 255 ? uint8_t{255} : static_cast<uint8_t>(duty);
  }
};

}  // namespace passo::chip
