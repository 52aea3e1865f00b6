// MessageSender: sends the messages of a Board to its host. It numbers the frames and passes them to the hardware.
// Portable.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/firmware/board_hardware.hpp"
#include "passo/wire/message.hpp"

namespace passo {

template <class Hardware>
class MessageSender {
 protected:
  explicit MessageSender(Hardware& hardware) : hardware_(hardware) {}

  bool has_room(uint8_t motors = 0) { return passo::has_room(hardware_, most_bytes(motors)); }

  // Separate functions. A frame is large for a chip's stack, so it is composed in the transmit buffer if that has room
  // for whole frames.
  template <class Message, class... More>
  [[gnu::noinline]] void send(const Message& message, More... more) {
    if constexpr (requires { hardware_.space(largest_frame); }) {
      hardware_.put(encode<SliceOf<Hardware>>(message, more..., sent_++, hardware_.space(most_bytes(more...))));
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
  // Returns the size of the longest frame for this number of motors. A host may ask for more motors than the board has.
  static constexpr uint8_t most_bytes(uint8_t motors = 0) {
    const uint8_t status = payload_size(static_cast<uint8_t>(MessageType::status), motors);
    constexpr uint8_t about = payload_size(static_cast<uint8_t>(MessageType::about), 0);
    return static_cast<uint8_t>(frame_overhead + (status > about ? status : about));
  }

  uint8_t sent_ = 0;  // the board's own sequence number
};

}  // namespace passo
