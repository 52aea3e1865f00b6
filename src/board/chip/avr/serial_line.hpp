// SerialLine: the polled UART. Received bytes wait in a ring that the expander fills too. Frames to send are composed
// in the transmit buffer itself.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "step_interrupt.hpp"

namespace passo::chip {

class SerialLine {
 public:
  // 2 MHz should be a multiple of `baud`: 500,000 and 1,000,000 fit. 115,200 is off by 2 %, as on every Uno.
  static void open(uint32_t clock, uint32_t baud) {
    const uint16_t divider = static_cast<uint16_t>((clock / 4 / baud - 1) / 2);
    Ubrr0h::write(static_cast<uint8_t>(divider >> 8));
    Ubrr0l::write(static_cast<uint8_t>(divider));
    Ucsr0a::write(1 << 1);           // eight samples per bit
    Ucsr0b::write(1 << 4 | 1 << 3);  // receiver and transmitter on, no interrupt
    Ucsr0c::write(1 << 2 | 1 << 1);  // 8N1
  }

  // Saves received bytes. Call at least every 640 cycles at 500 kbaud, the interrupt's time included: the UART itself
  // holds two bytes. So it is called between any two pieces of work, and must cost nothing when nothing was received.
  [[gnu::always_inline]] static void breathe() {
    if (line_is_watched == 0 && (Ucsr0a::read() & byte_received) != 0) fetch();
  }
  // Sends the next byte.
  static void poll() {
    breathe();
    if (sent_ != to_send_ && (Ucsr0a::read() & may_send) != 0) {
      Udr0::write(out_[sent_++]);
      if (sent_ == end_) {
        sent_ = 0;
        end_ = out_size;
      }
    }
  }

  static bool has_byte() { return taken_ != received_head; }
  // Returns the next received bytes: `count` of them are contiguous, `most` at most.
  static const uint8_t* next(uint8_t& count, uint8_t most) {
    const uint8_t before_wrap = static_cast<uint8_t>(-taken_);
    count = static_cast<uint8_t>(received_head - taken_);
    if (count > most) count = most;
    if (before_wrap != 0 && count > before_wrap) count = before_wrap;
    return reinterpret_cast<const uint8_t*>(received_address + taken_);
  }
  static uint8_t take() {
    uint8_t count;
    const uint8_t byte = *next(count, 1);
    drop(1);
    return byte;
  }
  static void drop(uint8_t count) { taken_ = static_cast<uint8_t>(taken_ + count); }

  // Returns the greatest possible size of the next frame. The frame is contiguous, after the waiting frames or before
  // them.
  [[gnu::noinline]] static uint8_t room() {
    if (sent_ == to_send_) sent_ = to_send_ = 0;
    if (to_send_ < sent_) return static_cast<uint8_t>(sent_ - to_send_ - 1);
    const uint8_t behind = room_behind();
    return sent_ > behind ? static_cast<uint8_t>(sent_ - 1) : behind;
  }
  // Whether there is room for everything that the board may send unsolicited.
  static bool can_send() { return room() >= longest; }
  // Returns where to write the next frame, which has at most `size` bytes and is sent after put(). If there is no room,
  // it replaces the waiting frames.
  static uint8_t* space(uint8_t size) {
    if (room() < size) {
      sent_ = to_send_ = 0;
      end_ = out_size;
    } else if (to_send_ >= sent_ && room_behind() < size) {
      end_ = to_send_;
      to_send_ = 0;
    }
    return out_ + to_send_;
  }
  static void put(uint8_t size) { to_send_ = static_cast<uint8_t>(to_send_ + size); }

 private:
  // Reads a received byte. The interrupt reads bytes too, so it must not come between the test and the store. Nor may
  // it be blocked, because its step edge would be late. So if the interrupt is due soon, this function waits until it
  // is over. The low bytes of the timer and of its compare register show whether it is due soon.
  [[gnu::noinline, gnu::used]] static void fetch() asm("passo_fetch") {
    asm volatile(
        R"(
      1:  lds r24, %[ocr]
          lds r25, %[tcnt]
          sub r24, r25
          cpi r24, 34
          brlo 1b                     ; from the second line to here 7 cycles
    )" PASSO_TAKE_BYTE "2:\n" ::[ocr] "n"(StepAlarm::where),
        [tcnt] "n"(StepCount::where), [ucsra] "n"(Ucsr0a::where), [udr] "n"(Udr0::where),
        [received] "n"(received_address)
        : "r24", "r25", "r30", "r31", "memory");
  }

  static uint8_t room_behind() { return static_cast<uint8_t>(out_size - 1 - to_send_); }

  // The longest frame: an about or a status message. If the host asks for more motors than the board has, the frame is
  // longer.
  static constexpr uint8_t longest = frame_overhead + (pins.motors < 4 ? 27 : status_size + 4 * pins.motors);
  static constexpr uint8_t out_size = pins.motors < 4 ? 64 : 128;
  static_assert(longest < out_size && largest_frame < out_size);

  static inline uint8_t taken_ = 0;
  static inline uint8_t out_[out_size] = {};
  static inline uint8_t to_send_ = 0;     // after the last frame
  static inline uint8_t sent_ = 0;        // the next byte to send
  static inline uint8_t end_ = out_size;  // end of the frames, if the next frame lies at the start of the buffer
};

}  // namespace passo::chip
