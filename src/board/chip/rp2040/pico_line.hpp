// PicoLine: the serial link, by UART0 or by USB: the board answers on the port on which a host speaks to it.
//
// The first host to send owns the link, until it has sent nothing for two seconds. Bytes of the other port are dropped
// meanwhile, so a second program cannot disturb a running job.
#pragma once

#include "pico_player.hpp"
#include "registers.hpp"
#include "usb_serial.hpp"

namespace passo::chip {

// UART0 holds 32 bytes each way; a ring holds further bytes to send.
class UartLine {
 public:
  static constexpr bool exists() { return pins.line_in != no_gpio; }
  // `clock` is the chip's clock in Hz.
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
  void poll() {
    while (head_ != tail_ && (UartFlags::read() & uart_full) == 0) UartData::write(ring_[tail_++ & ring_mask]);
  }

 private:
  static constexpr uint8_t ring_mask = 127;
  uint8_t ring_[ring_mask + 1] = {};
  uint8_t head_ = 0;
  uint8_t tail_ = 0;
};

class PicoLine {
 public:
  void open(uint32_t clock, uint32_t baud) {
    if (UartLine::exists()) UartLine::open(clock, baud);
    UsbSerial::open();
  }
  void poll() {
    if (UartLine::exists()) uart_.poll();
    usb_.poll();
    choose();
  }
  bool has_byte() const { return by_usb_ ? usb_.has_byte() : UartLine::has_byte(); }
  uint8_t take() {
    heard_at_ = TimerLow::read();
    taken_ = true;
    return by_usb_ ? usb_.take() : UartLine::take();
  }
  void send(uint8_t byte) { by_usb_ ? usb_.send(byte) : uart_.send(byte); }
  uint8_t room() const { return by_usb_ ? usb_.room() : uart_.room(); }
  bool can_send() const { return room() >= 63; }

  // Enables wake-up of the sleeping loop by a byte from either port.
  static void wake_on_news() {
    if (UartLine::exists()) UartImsc::write(uart_received);
    UsbSerial::wake_on_news();
  }

 private:
  static constexpr uint32_t silence = 2'000'000;  // microseconds

  void choose() {
    const bool other_speaks = by_usb_ ? UartLine::exists() && UartLine::has_byte() : usb_.has_byte();
    if (!other_speaks) return;
    if (taken_ && TimerLow::read() - heard_at_ < silence) {
      // The bytes of the other port are dropped.
      for (uint32_t i = 0; i < usb_packet && (by_usb_ ? UartLine::has_byte() : usb_.has_byte()); ++i) {
        by_usb_ ? UartLine::take() : usb_.take();
      }
      return;
    }
    by_usb_ = !by_usb_;
  }

  UartLine uart_;
  UsbSerial usb_;
  bool by_usb_ = !UartLine::exists();
  bool taken_ = false;  // a host has sent something
  uint32_t heard_at_ = 0;
};

}  // namespace passo::chip
