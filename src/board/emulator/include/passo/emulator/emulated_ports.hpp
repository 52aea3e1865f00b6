// EmulatedPorts: the pins of an AVR. The class replaces simavr's ports, which report every pin at every write, and
// whose pin change flags cannot be cleared one by one.
//
// As on the real chip, a one written to PINx toggles the output. A pin change sets the port's flag in PCIFR if the mask
// has that pin. On the ATmega2560 the pins INT0 to INT7 set their flags in EIFR if EICRA and EICRB are set for any
// change.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "passo/chip/pin.hpp"

struct avr_t;

namespace passo {

class EmulatedChip;

struct PortChange {
  std::uint64_t cycle = 0;
  char port = 0;
  std::uint8_t before = 0;
  std::uint8_t now = 0;
};

class EmulatedPorts {
 public:
  // `ports`: the letters of the ports.
  EmulatedPorts(EmulatedChip& chip, const std::string& ports);
  EmulatedPorts(const EmulatedPorts&) = delete;

  // If set, called with every change of an output register as it is made. The changes are then not recorded.
  std::function<void(const PortChange&)> on_change;
  // If set, called after every write to a direction register.
  std::function<void()> on_direction;
  // All recorded changes of output registers, in order of time.
  const std::vector<PortChange>& changes() const { return changes_; }
  void forget_changes() { changes_.clear(); }
  std::uint8_t outputs(char port) const;
  // A bit for each pin that is an output.
  std::uint8_t directions(char port) const;
  // Sets an input pin from outside.
  void set_input(char port, std::uint8_t bit, bool high);
  // Connects two pins through a key: while one pin is driven low, the other reads low.
  void connect(Pin row, Pin column, bool closed);

 private:
  struct Port {
    EmulatedPorts* all = nullptr;
    char name = 0;
    std::uint16_t pin = 0;       // address of PINx; DDRx and PORTx are the next two
    std::uint8_t levels = 0xff;  // levels applied to the pins from outside
  };
  struct Contact {
    Pin row;
    Pin column;
  };
  void write(Port& port, std::uint8_t value);
  std::uint8_t drawn_low(char port) const;
  void set_change_flag(std::uint8_t number);

  avr_t& avr_;
  std::array<Port, 12> ports_;
  std::vector<Contact> contacts_;
  std::vector<PortChange> changes_;
};

}  // namespace passo
