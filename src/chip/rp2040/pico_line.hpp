// PicoLine: the serial line, UART0. The UART holds 32 bytes each way; what is to be sent waits in a ring beside it.
#pragma once

#include "registers.hpp"

namespace passo::chip {

class PicoLine {
 public:
  // `clock` is the chip's.
  static void open(uint32_t clock, uint32_t baud) {
    const uint32_t divisor = clock * 4 / baud;  // in 64ths of sixteen cycles
    UartIbrd::write(divisor >> 6);
    UartFbrd::write(divisor & 63);
    UartLcr::write(3U << 5 | 1U << 4);  // eight bits, FIFOs
    UartCr::write(1U << 9 | 1U << 8 | 1U << 0);
  }
  static bool has_byte() { return (UartFlags::read() & uart_nothing_received) == 0; }
  static uint8_t take() { return static_cast<uint8_t>(UartData::read()); }

  void send(uint8_t byte) {
    while (static_cast<uint8_t>(head_ - tail_) == ring_mask) poll();
    ring_[head_++ & ring_mask] = byte;
    poll();
  }
  uint8_t room() const { return static_cast<uint8_t>(ring_mask - static_cast<uint8_t>(head_ - tail_)); }
  bool can_send() const { return room() >= ring_mask / 2; }
  void poll() {
    while (head_ != tail_ && (UartFlags::read() & uart_full) == 0) UartData::write(ring_[tail_++ & ring_mask]);
  }

 private:
  static constexpr uint8_t ring_mask = 127;
  uint8_t ring_[ring_mask + 1] = {};
  uint8_t head_ = 0;
  uint8_t tail_ = 0;
};

}  // namespace passo::chip
