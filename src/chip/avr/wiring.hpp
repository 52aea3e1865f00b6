// Wiring: all pins except the motors', taken from the board's pin map: switches, and switched outputs.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"

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
    enable_motors(false);
    prepare_ports();
    prepare_spindle();
    watch_switches();
  }

  static void enable_motors(bool on) {
#ifdef PASSO_WINDINGS
    if (!on) WindingPins::release();
#endif
#pragma clang loop unroll(full)
    for (const MotorPins& motor : pins.motor) set(motor.enable, !on);
  }

  // The action that switches the outputs to this and keeps everything else on their ports.
  static OutputAction action_of(const BoardOutputs& outputs) {
    const bool turns = pins.spindle_pwm.exists() && (outputs.switches & spindle_on) != 0;
    const uint8_t duty = turns ? duty_of(outputs.spindle_rpm) : uint8_t{0};
    return {.first_port = port_with(output_ports[0], outputs.switches),
            .second_port = port_with(output_ports[1], outputs.switches),
            .duty = duty,
            .control = duty != 0 ? spindle_connected : spindle_disconnected};
  }
  // Only while the interrupt does not play, because the interrupt does the same.
  [[gnu::always_inline]] static void act(const volatile OutputAction& action) {
    port_register(output_ports[0], 2) = action.first_port;
    port_register(output_ports[1], 2) = action.second_port;
    SpindleDuty::write(action.duty);
    SpindleControl::write(action.control);
  }

  // Switches these outputs off at rest, and tells whether one was on. A spindle that turns at no speed counts as off.
  [[gnu::noinline]] static bool switch_off(uint8_t switches) {
    bool was_on = false;
    if ((switches & spindle_on) != 0) {
      was_on = pins.spindle_pwm.exists() && SpindleControl::read() == spindle_connected;
      if (was_on) SpindleControl::write(spindle_disconnected);
      if (switch_off(pins.spindle_relay)) was_on = true;
    }
    if ((switches & mist_on) != 0 && switch_off(pins.mist)) was_on = true;
    if ((switches & flood_on) != 0 && switch_off(pins.flood)) was_on = true;
    return was_on;
  }

  // Bits of BoardInput, set where a switch is closed.
  static uint16_t inputs() {
    uint16_t on = 0;
#pragma clang loop unroll(full)
    for (uint8_t i = 0; i < most_axis_switches; ++i) {
      if (closed(pins.limits[i])) on |= static_cast<uint16_t>(input_limit << (i % 3));
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
    return pin.exists() && (port_register(pin.port, 0) & pin.mask()) == 0;
  }
  // A one written to PINx toggles the pin: no neighbour changes, even if the interrupt comes between.
  [[gnu::always_inline]] static void set(Pin pin, bool high) {
    if (!pin.exists()) return;
    const uint8_t now = port_register(pin.port, 2);
    port_register(pin.port, 0) = static_cast<uint8_t>((high ? ~now : now) & pin.mask());
  }

 private:
  [[gnu::always_inline]] static bool switch_off(Pin pin) {
    if (!pin.exists() || (port_register(pin.port, 2) & pin.mask()) == 0) return false;
    set(pin, false);
    return true;
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
      uint8_t which;
    } outputs[] = {{pins.spindle_direction, spindle_reverse},
                   {pins.spindle_relay, spindle_on},
                   {pins.mist, mist_on},
                   {pins.flood, flood_on}};
    uint8_t value = port_register(port, 2);
#pragma clang loop unroll(full)
    for (const auto& output : outputs) {
      if (output.pin.port != port) continue;
      value = static_cast<uint8_t>(value & ~output.pin.mask());
      if ((switches & output.which) != 0) value = static_cast<uint8_t>(value | output.pin.mask());
    }
    return value;
  }
  static uint8_t duty_of(uint16_t rpm) {
    const uint32_t duty = static_cast<uint32_t>(rpm) * (255 * 65536 / full_rpm + 1) >> 16;
    return duty > 255 ? uint8_t{255} : static_cast<uint8_t>(duty);
  }
};

}  // namespace passo::chip
