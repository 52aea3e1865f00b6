// BoardVoice: what a Board says to its host. It numbers the frames and puts them on the hardware's line. Portable.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/firmware/board_hardware.hpp"
#include "passo/wire/message.hpp"

namespace passo {

template <class Hardware>
class BoardVoice {
 protected:
  explicit BoardVoice(Hardware& hardware) : hardware_(hardware) {}

  bool has_room(MessageType type, uint8_t motors = 0) {
    return passo::has_room(hardware_,
                           static_cast<uint8_t>(frame_overhead + payload_size(static_cast<uint8_t>(type), motors)));
  }

  // Two functions of their own: a frame is large for a chip's stack, and two must never be there at once.
  template <class Message>
  [[gnu::noinline]] void send(const Message& message) {
    uint8_t frame[largest_frame];
    put_on_line(frame, encode<BreathOf<Hardware>>(message, sent_++, frame));
  }
  template <class Message>
  [[gnu::noinline]] void send_for_motors(const Message& message, uint8_t motors) {
    uint8_t frame[largest_frame];
    put_on_line(frame, encode<BreathOf<Hardware>>(message, motors, sent_++, frame));
  }
  void put_on_line(const uint8_t* frame, uint8_t size) {
    for (uint8_t i = 0; i < size; ++i) hardware_.send(frame[i]);
  }

  Hardware& hardware_;

 private:
  uint8_t sent_ = 0;  // the board's own sequence number
};

}  // namespace passo
