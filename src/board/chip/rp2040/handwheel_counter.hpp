// HandwheelCounter: a handwheel at two pins. Each edge is an interrupt, which reads both pins. The steps are made by
// the state machine, so none of them is later for it.
//
// Noise must not take all of the processor's time: after `most_edges` edges within one turn of the main loop, the
// interrupt is off until the next turn.
#pragma once

#include "pico_player.hpp"
#include "registers.hpp"

#include "passo/firmware/quadrature_counter.hpp"
#include "passo/wire/handwheel_count.hpp"

namespace passo::chip {

class HandwheelCounter {
 public:
  static constexpr bool exists() { return pins.has_handwheel(); }

  static void prepare() {
    if (exists()) counter_.begin(lines());
  }
  static void listen() {
    if (exists()) gpio_interrupts(pins.wheel.a) = gpio_interrupts(pins.wheel.a) | edges;
  }

  // Call in each turn of the main loop.
  static void poll() {
    if (!exists()) return;
    interrupts_off();
    if (left_ == 0) {
      gpio_edges(pins.wheel.a) = edges;
      counter_.update(lines());
      listen();
    }
    left_ = most_edges;
    interrupts_on();
  }
  // Handles the pin interrupt. The edges are forgotten before the pins are read, so that none is missed.
  [[gnu::always_inline]] static void moved() {
    if (!exists() || (gpio_edges(pins.wheel.a) & edges) == 0) return;
    gpio_edges(pins.wheel.a) = edges;
    counter_.update(lines());
    if (left_ == 0) return;
    left_ = left_ - 1;
    if (left_ == 0) gpio_interrupts(pins.wheel.a) = gpio_interrupts(pins.wheel.a) & ~edges;
  }
  // The bits of the edges that moved() forgets itself, in the register of this pin.
  static constexpr uint32_t edges_beside(uint32_t gpio) {
    return exists() && gpio / 8 == pins.wheel.a / 8U ? edges : 0;
  }

  static HandwheelCount count() {
    interrupts_off();
    const HandwheelCount now = {.count = counter_.count(), .jumps = counter_.jumps(), .selected = selected()};
    interrupts_on();
    return now;
  }

 private:
  static constexpr uint32_t most_edges = 32;
  static constexpr uint32_t edges =
      edge_bits(pins.wheel.a, edge_low | edge_high) | edge_bits(pins.wheel.b, edge_low | edge_high);

  [[gnu::always_inline]] static uint8_t lines() {
    const uint32_t levels = GpioIn::read();
    return static_cast<uint8_t>(((levels & gpio_bit(pins.wheel.a)) != 0 ? QuadratureCounter::line_a : 0) |
                                ((levels & gpio_bit(pins.wheel.b)) != 0 ? QuadratureCounter::line_b : 0));
  }
  // A selector that is on connects its input to ground.
  static uint8_t selected() {
    const uint32_t levels = GpioIn::read();
    uint32_t on = 0;
    for (uint32_t i = 0; i < handwheel_axes; ++i) {
      if ((levels & gpio_bit(pins.wheel.axes[i])) == 0) on |= uint32_t{handwheel_axis} << i;
    }
    if ((levels & gpio_bit(pins.wheel.tenfold)) == 0) on |= handwheel_tenfold;
    if ((levels & gpio_bit(pins.wheel.hundredfold)) == 0) on |= handwheel_hundredfold;
    return static_cast<uint8_t>(on);
  }

  static inline QuadratureCounter counter_;
  static inline volatile uint32_t left_ = most_edges;  // until the interrupt is off
};

}  // namespace passo::chip
