// EmulatedChip: an AVR that runs a real program, instruction by instruction, in simavr. The user watches and feeds
// single registers. Time is the chip's clock, in cycles from reset, so the same program gives the same figures
// everywhere.
//
// Registers are named by their addresses in data memory, as in the data sheet's second column.
//
// simavr 1.6 counts the cycles of instructions as the data sheet does (timing_test.cpp). Two differences are mended
// here. In simavr, entering an interrupt costs nothing; in silicon, 4 cycles, or 5 where the program counter has three
// bytes. In simavr, a pending interrupt is served two instructions after SEI or RETI; in silicon, one. simavr's timer
// and serial line are replaced: emulated_timer.hpp, emulated_uart.hpp.
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
  // Sets the source of what the program reads from a register.
  void on_read(std::uint16_t address, std::function<std::uint8_t()> source);

  // Runs until a watcher or a source calls stop(). Throws std::runtime_error if the program crashes or sleeps for good,
  // or if `most_cycles` pass before.
  void run(std::uint64_t most_cycles);
  // The run ends after the instruction that is being executed.
  void stop();
  // Runs until at least this many cycles have passed, or stop() is called. Throws if the program crashes.
  void run_for(std::uint64_t cycles);

  // How many adjacent bytes of memory the program has not written since it started: what the stack has left free.
  std::size_t longest_untouched() const;

  // For the classes that replace simavr's own peripherals.
  avr_t& avr() { return *avr_; }

  // The start of the instruction that is being executed.
  std::uint64_t cycles() const;

 private:
  struct Deleter {
    void operator()(avr_t* avr) const;
  };

  void mend_interrupts();
  // Runs one stretch of instructions.
  void step();

  std::unique_ptr<avr_t, Deleter> avr_;
  std::uint8_t entry_cycles_ = 4;
  std::deque<std::function<void(std::uint8_t)>> watchers_;  // simavr keeps their addresses
  std::deque<std::function<std::uint8_t()>> sources_;
  bool stopped_ = false;
};

}  // namespace passo
