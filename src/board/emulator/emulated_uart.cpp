#include "passo/emulator/emulated_uart.hpp"

#include <algorithm>

#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>
#include <simavr/sim_io.h>

#include "passo/emulator/emulated_chip.hpp"

namespace passo {
namespace {

constexpr std::uint16_t ucsr0a = 0xc0;
constexpr std::uint16_t ucsr0b = 0xc1;
constexpr std::uint16_t udr0 = 0xc6;
constexpr std::uint32_t clock_rate = 16'000'000;

}  // namespace

EmulatedUart::EmulatedUart(EmulatedChip& chip, std::uint32_t baud)
    : avr_(chip.avr()), byte_cycles_((10 * clock_rate + baud / 2) / baud) {
  avr_.io[AVR_DATA_TO_IO(ucsr0a)].r = {.param = this, .c = [](avr_t*, avr_io_addr_t, void* self) {
                                         auto& uart = *static_cast<EmulatedUart*>(self);
                                         uart.record_poll();
                                         return static_cast<std::uint8_t>((uart.received_bytes_.empty() ? 0 : 0x80) |
                                                                          (uart.to_send_.size() < 2 ? 0x20 : 0) |
                                                                          (uart.to_send_.empty() ? 0x40 : 0));
                                       }};
  avr_.io[AVR_DATA_TO_IO(ucsr0a)].w = {
      .param = this,
      .c = [](avr_t* avr, avr_io_addr_t address, std::uint8_t value, void*) { avr->data[address] = value; }};
  avr_.io[AVR_DATA_TO_IO(ucsr0b)].w = avr_.io[AVR_DATA_TO_IO(ucsr0a)].w;
  avr_.io[AVR_DATA_TO_IO(udr0)].r = {.param = this, .c = [](avr_t*, avr_io_addr_t, void* self) {
                                       auto& bytes = static_cast<EmulatedUart*>(self)->received_bytes_;
                                       if (bytes.empty()) return std::uint8_t{0};
                                       const std::uint8_t byte = bytes.front();
                                       bytes.pop_front();
                                       return byte;
                                     }};
  avr_.io[AVR_DATA_TO_IO(udr0)].w = {.param = this, .c = [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
                                       auto& uart = *static_cast<EmulatedUart*>(self);
                                       if (uart.to_send_.size() >= 2) return;  // lost, as in silicon
                                       uart.to_send_.push_back(value);
                                       if (uart.to_send_.size() == 1) {
                                         avr_cycle_timer_register(avr, uart.byte_cycles_, on_line_out, self);
                                       }
                                     }};
}

void EmulatedUart::send(std::span<const std::uint8_t> bytes) {
  const bool idle = line_.empty();
  line_.insert(line_.end(), bytes.begin(), bytes.end());
  if (idle && !bytes.empty()) avr_cycle_timer_register(&avr_, byte_cycles_, on_line_in, this);
}

void EmulatedUart::record_poll() {
  constexpr std::uint8_t receives = 1 << 4;
  if ((avr_.data[ucsr0b] & receives) == 0) return;  // the program has not opened the line yet
  if (looked_ != 0) longest_unwatched_ = std::max(longest_unwatched_, avr_.cycle - looked_);
  looked_ = avr_.cycle;
}

std::uint64_t EmulatedUart::on_line_in(avr_t* /*avr*/, std::uint64_t when, void* self) {
  auto& uart = *static_cast<EmulatedUart*>(self);
  const std::uint8_t byte = uart.line_.front();
  uart.line_.pop_front();
  ++uart.received_;
  if (uart.received_bytes_.size() < 2) {
    uart.received_bytes_.push_back(byte);
  } else {
    ++uart.overruns_;
  }
  return uart.line_.empty() ? 0 : when + uart.byte_cycles_;
}

std::uint64_t EmulatedUart::on_line_out(avr_t* /*avr*/, std::uint64_t when, void* self) {
  auto& uart = *static_cast<EmulatedUart*>(self);
  const std::uint8_t byte = uart.to_send_.front();
  uart.to_send_.pop_front();
  if (uart.on_byte) uart.on_byte(byte);
  return uart.to_send_.empty() ? 0 : when + uart.byte_cycles_;
}

}  // namespace passo
