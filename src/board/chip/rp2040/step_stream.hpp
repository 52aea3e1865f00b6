// StepStream: sets the step and direction pins to the states of a list, each at its exact tick, independent of the
// processor. A state machine of the PIO plays the list; the DMA transfers it word by word.
//
//   word    delay (16 bits) | pins (16 bits): the pins are set delay + 4 ticks after those of the word before
//
//   pull block      takes the next word, or waits for one         1 tick
//   out x, 16       the delay                                     1
//   jmp x--         counts it down                                delay + 1
//   out pins, 16    all motors' pins change at the same moment    1
//
// The words lie in a ring. The main loop calls push() and publish(). The DMA's interrupt passes newly published words
// to the DMA. One tick is eight cycles of the chip.
#pragma once

#include "registers.hpp"

namespace passo::chip {

class StepStream {
 public:
  static constexpr uint32_t words = 8192;  // 32 KiB, the largest ring that the DMA supports
  static constexpr uint32_t ticks_of_word = 4;
  static constexpr uint32_t cycles_of_tick = 8;

  // `first`: the GPIO of bit 0. `pins`: the driven pins, relative to `first`.
  static void prepare(uint32_t first, uint32_t pins) {
    pio_program(0) = 0x80a0;
    pio_program(1) = 0x6030;
    pio_program(2) = 0x0042;
    pio_program(3) = 0x6010;
    PioClkdiv::write(cycles_of_tick << 16);
    PioExecctrl::write(3U << 12);   // wraps from 3 to 0
    PioShiftctrl::write(1U << 19);  // shifts right: the low half is first
    PioPinctrl::write(16U << 20 | first);
    set_pins(0);
    for (uint32_t bit = 0; bit < 16; ++bit) execute_direction(first, bit, (pins >> (first + bit) & 1) != 0);
    PioPinctrl::write(16U << 20 | first);
    DmaWriteAddr::write(PioTxf0::where);
    DmaInte0::write(1);
    restart();
  }

  // Drops everything that was not played, and restarts with these pin levels.
  static void restart(uint16_t pins = 0) {
    interrupts_off();
    halt();
    DmaInte0::write(0);
    DmaAbort::write(1);
    while ((DmaCtrl::read() & dma_busy) != 0) {
    }
    DmaInts0::write(1);
    PioCtrl::write(restart_machine);
    for (uint32_t i = 0; i < 8; ++i) PioInstr::write(pull_if_any);
    set_pins(pins);
    PioInstr::write(0);  // jmp 0
    head_ = 0;
    published_ = 0;
    handed_ = 0;
    DmaReadAddr::write(reinterpret_cast<uint32_t>(ring_));
    DmaCtrl::write(dma_settings);
    DmaInte0::write(1);
    PioCtrl::write(1);
    interrupts_on();
  }
  // Stops at once: the pins do not change until restart().
  [[gnu::always_inline]] static void halt() { PioCtrl::write(0); }

  // Returns the number of words ever pushed, and the number already output at the pins.
  static uint32_t pushed() { return head_; }
  static uint32_t played() {
    while (true) {
      const uint32_t address = DmaReadAddr::read();
      const uint32_t place = PioAddr::read();
      const uint32_t level = PioFlevel::read() & 15;
      const uint32_t handed = handed_;
      // None of the three values changed between the two readings.
      if (place != PioAddr::read() || level != (PioFlevel::read() & 15) || address != DmaReadAddr::read()) continue;
      const uint32_t read = (address - reinterpret_cast<uint32_t>(ring_)) / 4;
      const uint32_t taken = handed - ((handed - read) & (words - 1));
      return taken - level - (place != 0 ? 1 : 0);
    }
  }
  static bool dry() { return played() == head_; }
  static uint32_t room() { return words - 1 - (head_ - played()); }

  // `ticks`: ticks since the word before, at least four.
  static constexpr uint32_t word(uint32_t ticks, uint32_t pins) { return (ticks - ticks_of_word) | pins << 16; }
  [[gnu::always_inline]] static void push(uint32_t ticks, uint32_t pins) {
    ring_[head_ & (words - 1)] = word(ticks, pins);
    head_ = head_ + 1;
  }
  // For pushing many words at once: returns the address for up to `pairs` pairs of words, fewer if the ring ends
  // before. Call keep() afterwards to push the words.
  static uint32_t* space(uint32_t& pairs) {
    const uint32_t place = head_ & (words - 1);
    const uint32_t fit = (words - place) / 2;
    if (pairs > fit) pairs = fit == 0 ? 1 : fit;
    return fit == 0 ? across_ : ring_ + place;
  }
  static void keep(uint32_t pairs) {
    if ((head_ & (words - 1)) == words - 1) {
      ring_[words - 1] = across_[0];
      ring_[0] = across_[1];
    }
    head_ = head_ + 2 * pairs;
  }
  static void drop() { head_ = head_ - 1; }
  // Publishes the words that the pins will follow: all words pushed, except for the last `kept_back` ones.
  static uint32_t published() { return published_; }
  static void publish(uint32_t kept_back = 0) {
    interrupts_off();
    published_ = head_ - kept_back;
    if ((DmaCtrl::read() & dma_busy) == 0) hand_over();
    interrupts_on();
  }
  // Handles the DMA's interrupt.
  [[gnu::always_inline]] static void refill_done() {
    DmaInts0::write(1);
    if ((DmaCtrl::read() & dma_busy) == 0) hand_over();
  }

 private:
  static constexpr uint32_t dma_busy = 1U << 24;
  // Enabled, high priority, 32 bits, read address incremented and wrapped within the ring, paced by the state machine
  // (DREQ_PIO0_TX0), chained to itself, that is, not chained.
  static constexpr uint32_t dma_settings = 1U << 0 | 1U << 1 | 2U << 2 | 1U << 4 | 15U << 6 | 0U << 11 | 0U << 15;
  static constexpr uint32_t restart_machine = 1U << 4;
  static constexpr uint32_t pull_if_any = 0x8080;

  [[gnu::always_inline]] static void hand_over() {
    const uint32_t count = published_ - handed_;
    if (count == 0) return;
    handed_ = published_;
    DmaTransCountTrig::write(count);
  }
  static void set_pins(uint32_t pins) {
    PioTxf0::write(pins << 16);
    PioInstr::write(pull_if_any);
    PioInstr::write(0x6070);  // out null, 16
    PioInstr::write(0x6010);
  }
  // Makes one pin of the window an output or an input: set pindirs, 1.
  static void execute_direction(uint32_t first, uint32_t bit, bool output) {
    if (!output) return;
    PioPinctrl::write(1U << 26 | (first + bit) << 5);
    PioInstr::write(0xe081);
  }

  [[gnu::section(".bss.ring")]] static inline uint32_t ring_[words];
  static inline uint32_t across_[2];  // a pair whose first word is the ring's last
  static inline volatile uint32_t head_ = 0;
  static inline volatile uint32_t published_ = 0;
  static inline volatile uint32_t handed_ = 0;
};

}  // namespace passo::chip
