// EmulatedPorts: the pins of an AVR. Stands in for simavr's ports, which tell every pin of every write to whoever might
// want it, and know no flags of pin changes that can be cleared one by one.
//
// As in silicon: a one written to PINx turns the output over; a pin change sets its port's flag in PCIFR where the mask
// has that pin. On the ATmega2560 the pins INT0 to INT7 set theirs in EIFR where EICRA and EICRB ask for any change.
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
  // `ports`: their letters.
  EmulatedPorts(EmulatedChip& chip, const std::string& ports);
  EmulatedPorts(const EmulatedPorts&) = delete;

  // Called with every change of an output register as it is made, in the place of keeping it.
  std::function<void(const PortChange&)> on_change;
  // Every change of an output register, in order of time.
  const std::vector<PortChange>& changes() const { return changes_; }
  void forget_changes() { changes_.clear(); }
  std::uint8_t outputs(char port) const;
  // From outside.
  void set_input(char port, std::uint8_t bit, bool high);
  // A key between two pins: while one is drawn low the other reads low.
  void connect(Pin row, Pin column, bool closed);

 private:
  struct Port {
    EmulatedPorts* all = nullptr;
    char name = 0;
    std::uint16_t pin = 0;       // address of PINx; DDRx and PORTx are the next two
    std::uint8_t levels = 0xff;  // that something outside gives it
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
