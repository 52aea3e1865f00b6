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

  // Functions of their own. A frame is large for a chip's stack: where the line has room for whole frames, it is put
  // together there.
  template <class Message, class... More>
  [[gnu::noinline]] void send(const Message& message, More... more) {
    if constexpr (requires { hardware_.space(); }) {
      hardware_.put(encode<SliceOf<Hardware>>(message, more..., sent_++, hardware_.space()));
    } else {
      uint8_t frame[largest_frame];
      const uint8_t size = encode<SliceOf<Hardware>>(message, more..., sent_++, frame);
      for (uint8_t i = 0; i < size; ++i) hardware_.send(frame[i]);
    }
  }
  template <class Message>
  void send_for_motors(const Message& message, uint8_t motors) {
    send(message, motors);
  }

  Hardware& hardware_;

 private:
  uint8_t sent_ = 0;  // the board's own sequence number
};

}  // namespace passo
