// EmulatedUart: the serial line of the ATmegas. Stands in for simavr's, which takes 11 bits a byte, has 64 bytes of
// receive buffer and no second one to send, and so hides what is lost.
//
// As in silicon: 8N1, two bytes received and not yet read, what comes then is lost; a byte to send waits while the one
// before it is on the line.
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

  // The host's side: bytes onto the line, one after the other.
  void send(std::span<const std::uint8_t> bytes);
  std::size_t under_way() const { return line_.size(); }
  // Called with each byte when its last bit has left the chip.
  std::function<void(std::uint8_t)> on_byte;

  std::uint64_t overruns() const { return overruns_; }
  std::uint64_t received() const { return received_; }
  // The longest time, in cycles, in which the program has not looked whether a byte has come, whether one had or not.
  std::uint64_t longest_unwatched() const { return longest_unwatched_; }

 private:
  void note_look();
  static std::uint64_t on_line_in(avr_t* avr, std::uint64_t when, void* self);
  static std::uint64_t on_line_out(avr_t* avr, std::uint64_t when, void* self);

  avr_t& avr_;
  std::uint32_t byte_cycles_;
  std::deque<std::uint8_t> line_;            // on its way to the chip
  std::deque<std::uint8_t> received_bytes_;  // in the chip, not yet read
  std::deque<std::uint8_t> to_send_;         // the first one is on the line
  std::uint64_t overruns_ = 0;
  std::uint64_t received_ = 0;
  std::uint64_t looked_ = 0;
  std::uint64_t longest_unwatched_ = 0;
};

}  // namespace passo
