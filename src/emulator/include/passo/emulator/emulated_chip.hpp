// EmulatedChip: an AVR that runs a real program, instruction by instruction, in simavr. Whoever drives it watches and
// feeds single registers; time is the chip's clock, in cycles from reset, so the same program gives the same figures
// everywhere.
//
// Registers are named by their addresses in data memory, as the data sheet's second column has them.
//
// simavr 1.6 counts instructions as the data sheet does (timing_test.cpp). Mended here: entering an interrupt costs
// nothing there (in silicon 4 cycles, 5 where the program counter has three bytes), and a pending one is served two
// instructions after SEI or RETI (in silicon one). Its timer and its serial line are replaced: emulated_timer.hpp,
// emulated_uart.hpp.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>

struct avr_t;

namespace passo {

class EmulatedChip {
 public:
  // `program` is an ELF file. Throws std::runtime_error where it cannot be read or there is no such chip.
  explicit EmulatedChip(const std::string& program, const std::string& mcu = "atmega328p");

  // What the program writes to a register, as it writes it.
  void on_write(std::uint16_t address, std::function<void(std::uint8_t)> watcher);
  // What the program reads from a register.
  void on_read(std::uint16_t address, std::function<std::uint8_t()> source);

  // Runs until stop() is called from one of these. Throws std::runtime_error where the program crashes or sleeps for
  // good, or where `most_cycles` pass before.
  void run(std::uint64_t most_cycles);
  void stop() { stopped_ = true; }
  // Runs until at least that many cycles have passed, or stop() is called. Throws where the program crashes.
  void run_for(std::uint64_t cycles);

  // Bytes of memory, one after the other, that the program has not written since it started: what the stack has left.
  std::size_t longest_untouched() const;

  // For what stands in for simavr's own peripherals.
  avr_t& avr() { return *avr_; }

  // The start of the instruction that is being executed.
  std::uint64_t cycles() const;

 private:
  struct Deleter {
    void operator()(avr_t* avr) const;
  };

  void mend_interrupts();
  // One stretch of instructions.
  void step();

  std::unique_ptr<avr_t, Deleter> avr_;
  std::uint8_t entry_cycles_ = 4;
  std::deque<std::function<void(std::uint8_t)>> watchers_;  // simavr keeps their addresses
  std::deque<std::function<std::uint8_t()>> sources_;
  bool stopped_ = false;
};

}  // namespace passo
