// Inquiry: asks a board for its properties and its status, without disturbing its work.
//
// A board answers `ask` at any time, also during motion, and nothing in it changes (docs/wire.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/link/board_port.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class Inquiry {
 public:
  // `port` must outlive the Inquiry.
  explicit Inquiry(BoardPort& port);

  // Asks again and again until an answer comes or the time is over: after it was opened, an Arduino is in its boot
  // loader for a second or two.
  std::optional<About> about(Seconds within);
  std::optional<BoardStatus> status(Seconds within);
  // Asks until the board rests, however long that takes, as long as it answers. Two equal answers are needed: a chip
  // that has made its last event may not have counted the item yet.
  std::optional<BoardStatus> status_at_rest(Seconds within);
  // Text that came instead of an answer, as far as it can be read: the greeting of another firmware.
  const std::string& heard() const { return heard_; }

 private:
  bool ask(Question question, MessageType answer, Seconds within);

  BoardPort& port_;
  Decoder decoder_;
  std::string heard_;
};

}  // namespace passo
