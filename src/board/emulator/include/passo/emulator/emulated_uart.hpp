// EmulatedUart: the UART of the ATmegas. The class replaces simavr's, which takes 11 bits per byte, has a receive
// buffer of 64 bytes and no second transmit byte. So simavr's UART would hide lost bytes.
//
// As on the real chip, a byte has 10 bits (8N1). Up to two received bytes wait to be read, and a further byte is lost.
// A byte to send waits until the previous byte has been transmitted.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>

struct avr_t;

namespace passo {

class EmulatedChip;

class EmulatedUart {
 public:
  EmulatedUart(EmulatedChip& chip, std::uint32_t baud);
  EmulatedUart(const EmulatedUart&) = delete;

  // The host's side: sends bytes to the chip, one after the other.
  void send(std::span<const std::uint8_t> bytes);
  std::size_t under_way() const { return line_.size(); }
  // Called with each byte when its last bit has left the chip.
  std::function<void(std::uint8_t)> on_byte;

  std::uint64_t overruns() const { return overruns_; }
  std::uint64_t received() const { return received_; }
  // Returns the longest time, in cycles, between two checks of the program for a received byte, whether or not one was
  // waiting.
  std::uint64_t longest_unwatched() const { return longest_unwatched_; }

 private:
  void record_poll();
  static std::uint64_t on_line_in(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t on_line_out(avr_t* avr, std::uint64_t when, void* self);

  avr_t& avr_;
  std::uint32_t byte_cycles_;
  std::deque<std::uint8_t> line_;            // bytes in transmission to the chip
  std::deque<std::uint8_t> received_bytes_;  // in the chip, not yet read
  std::deque<std::uint8_t> to_send_;         // the first byte is being transmitted
  std::uint64_t overruns_ = 0;
  std::uint64_t received_ = 0;
  std::uint64_t looked_ = 0;
  std::uint64_t longest_unwatched_ = 0;
};

}  // namespace passo
