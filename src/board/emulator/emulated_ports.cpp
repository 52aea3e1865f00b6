#include "passo/emulator/emulated_ports.hpp"

#include <algorithm>

#include <simavr/sim_avr.h>
#include <simavr/sim_io.h>

#include "passo/emulator/emulated_chip.hpp"

namespace passo {
namespace {

constexpr std::uint16_t pcifr = 0x3b;
constexpr std::uint16_t eifr = 0x3c;
constexpr std::uint16_t eicra = 0x69;
constexpr std::uint8_t any_change = 1;  // value of a pin's two bits in EICRA, EICRB
// Registers from this address on are reached as memory: a write comes in the second cycle of its instruction.
constexpr std::uint16_t first_memory_register = 0x60;
constexpr std::uint16_t pcmsk0 = 0x6b;

// PINA, PINB and so on of the data sheets. There is no port I.
std::uint16_t pin_address(char port) {
  if (port < 'H') return static_cast<std::uint16_t>(0x20 + 3 * (port - 'A'));
  return static_cast<std::uint16_t>(0x100 + 3 * (port - 'H' - (port > 'I' ? 1 : 0)));
}

}  // namespace

EmulatedPorts::EmulatedPorts(EmulatedChip& chip, const std::string& ports) : avr_(chip.avr()) {
  for (const char name : ports) {
    Port& port = ports_.at(static_cast<std::size_t>(name - 'A'));
    port = {.all = this, .name = name, .pin = pin_address(name), .levels = 0xff};
    const std::uint16_t pin = port.pin;
    avr_.io[AVR_DATA_TO_IO(pin)].r = {
        .param = &port, .c = [](avr_t* avr, avr_io_addr_t address, void* which) {
          const std::uint8_t outputs = avr->data[address + 1];
          const auto& read = *static_cast<Port*>(which);
          const unsigned levels = read.levels & ~unsigned{read.all->drawn_low(read.name)};
          return static_cast<std::uint8_t>((avr->data[address + 2] & outputs) | (levels & ~unsigned{outputs}));
        }};
    avr_.io[AVR_DATA_TO_IO(pin)].w = {.param = &port,
                                      .c = [](avr_t* avr, avr_io_addr_t address, std::uint8_t value, void* which) {
                                        auto& toggled = *static_cast<Port*>(which);
                                        toggled.all->write(toggled, avr->data[address + 2] ^ value);
                                      }};
    avr_.io[AVR_DATA_TO_IO(pin + 1)].w = {.param = &port,
                                          .c = [](avr_t* avr, avr_io_addr_t address, std::uint8_t value, void* which) {
                                            avr->data[address] = value;
                                            const auto& all = *static_cast<Port*>(which)->all;
                                            if (all.on_direction) all.on_direction();
                                          }};
    avr_.io[AVR_DATA_TO_IO(pin + 2)].w = {.param = &port,
                                          .c = [](avr_t*, avr_io_addr_t, std::uint8_t value, void* which) {
                                            auto& written = *static_cast<Port*>(which);
                                            written.all->write(written, value);
                                          }};
  }
  for (const std::uint16_t flags : {pcifr, eifr}) {
    avr_.io[AVR_DATA_TO_IO(flags)].w = {.param = nullptr,
                                        .c = [](avr_t* avr, avr_io_addr_t address, std::uint8_t value, void*) {
                                          avr->data[address] = static_cast<std::uint8_t>(avr->data[address] & ~value);
                                        }};
  }
}

void EmulatedPorts::write(Port& port, std::uint8_t value) {
  std::uint8_t& output = avr_.data[port.pin + 2];
  const std::uint64_t cycle = avr_.cycle + (port.pin >= first_memory_register ? 1 : 0);
  const PortChange change{.cycle = cycle, .port = port.name, .before = output, .now = value};
  output = value;
  if (change.before == value) return;
  if (on_change) {
    on_change(change);
  } else {
    changes_.push_back(change);
  }
}

std::uint8_t EmulatedPorts::outputs(char port) const {
  return avr_.data[pin_address(port) + 2];
}

std::uint8_t EmulatedPorts::directions(char port) const {
  return avr_.data[pin_address(port) + 1];
}

void EmulatedPorts::connect(Pin row, Pin column, bool closed) {
  if (closed) {
    contacts_.push_back({row, column});
  } else {
    std::erase_if(contacts_, [&](const Contact& one) { return one.row == row && one.column == column; });
  }
}

std::uint8_t EmulatedPorts::drawn_low(char port) const {
  unsigned low = 0;
  for (const Contact& one : contacts_) {
    const std::uint16_t column = pin_address(one.column.port);
    const bool draws = (avr_.data[column + 1] & ~avr_.data[column + 2] & one.column.mask()) != 0;
    if (one.row.port == port && draws) low |= one.row.mask();
  }
  return static_cast<std::uint8_t>(low);
}

void EmulatedPorts::set_input(char port, std::uint8_t bit, bool high) {
  Port& changed = ports_.at(static_cast<std::size_t>(port - 'A'));
  const auto mask = static_cast<std::uint8_t>(1U << bit);
  const auto levels = static_cast<std::uint8_t>(high ? changed.levels | mask : changed.levels & ~mask);
  if (levels == changed.levels) return;
  changed.levels = levels;
  if (avr_.address_size == 3 && ((port == 'D' && bit < 4) || (port == 'E' && bit >= 4))) set_change_flag(bit);
  // Groups 0 to 2 are ports B, C, D on the 328P; B, (E0 and J), K on the 2560.
  const bool large = avr_.address_size == 3;
  const int group = port == 'B' ? 0 : port == (large ? 'J' : 'C') ? 1 : port == (large ? 'K' : 'D') ? 2 : -1;
  if (group < 0) return;
  const unsigned watched = port == 'J' ? unsigned{mask} << 1U : unsigned{mask};
  if ((avr_.data[pcmsk0 + static_cast<unsigned>(group)] & watched) != 0) {
    avr_.data[pcifr] = static_cast<std::uint8_t>(avr_.data[pcifr] | 1U << static_cast<unsigned>(group));
  }
}

// On the 2560, INT0 to INT3 are on D0 to D3, and INT4 to INT7 on E4 to E7: the pin's number is the interrupt's number.
void EmulatedPorts::set_change_flag(std::uint8_t number) {
  const unsigned sense = avr_.data[eicra + number / 4] >> (number % 4 * 2) & 3U;
  if (sense == any_change) avr_.data[eifr] = static_cast<std::uint8_t>(avr_.data[eifr] | 1U << number);
}

}  // namespace passo
