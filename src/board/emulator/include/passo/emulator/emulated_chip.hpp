// EmulatedChip: an AVR that runs a real program, instruction by instruction, in simavr. The caller watches and sets
// individual registers. Time is the chip's clock, in cycles from reset, so a program gives the same results on every
// computer.
//
// Registers are named by their addresses in data memory, as in the data sheet's second column.
//
// simavr 1.6 counts the cycles of instructions as the data sheet does (timing_test.cpp). Two differences are corrected
// here. In simavr, entering an interrupt costs nothing; in silicon, 4 cycles, or 5 where the program counter has three
// bytes. In simavr, a pending interrupt is served two instructions after SEI or RETI; in silicon, one. simavr's timer
// and UART are replaced: emulated_timer.hpp, emulated_uart.hpp.
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
  // `program` is an ELF file. Throws std::runtime_error if the file cannot be read or there is no such chip.
  explicit EmulatedChip(const std::string& program, const std::string& mcu = "atmega328p");

  // Calls the watcher with each value that the program writes to a register, at the moment of writing.
  void on_write(std::uint16_t address, std::function<void(std::uint8_t)> watcher);
  // Sets the function that supplies the values which the program reads from a register.
  void on_read(std::uint16_t address, std::function<std::uint8_t()> source);

  // Runs until a watcher or a source calls stop(). Throws std::runtime_error if the program crashes or sleeps for good,
  // or if `most_cycles` pass before.
  void run(std::uint64_t most_cycles);
  // The run ends after the instruction that is being executed.
  void stop();
  // Runs until at least this many cycles have passed, or stop() is called. Throws if the program crashes.
  void run_for(std::uint64_t cycles);

  // Returns the length of the longest block of memory that the program has not written since its start: the free stack
  // space.
  std::size_t longest_untouched() const;

  // Access for the classes that replace simavr's own peripherals.
  avr_t& avr() { return *avr_; }

  // Returns the cycle at which the current instruction started.
  std::uint64_t cycles() const;

 private:
  struct Deleter {
    void operator()(avr_t* avr) const;
  };

  void mend_interrupts();
  // Runs one batch of instructions.
  void step();

  std::unique_ptr<avr_t, Deleter> avr_;
  std::uint8_t entry_cycles_ = 4;
  std::deque<std::function<void(std::uint8_t)>> watchers_;  // simavr keeps their addresses
  std::deque<std::function<std::uint8_t()>> sources_;
  bool stopped_ = false;
};

}  // namespace passo
