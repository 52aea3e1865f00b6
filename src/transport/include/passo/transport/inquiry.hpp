// Inquiry: asks a board what it is and how it is, without disturbing what it does.
//
// A board answers `ask` at any time, amid motion too, and nothing about it changes (docs/wire.md).
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
  // The port outlives it.
  explicit Inquiry(BoardPort& port);

  // Asks again and again until an answer comes or the time is over: an Arduino that was just opened is in its boot
  // loader for a second or two.
  std::optional<About> about(Seconds within);
  std::optional<BoardStatus> status(Seconds within);
  // Asks until it rests, however long that takes as long as it answers: two answers alike, for a chip that has made its
  // last event may not have counted the item yet.
  std::optional<BoardStatus> status_at_rest(Seconds within);
  // What came instead of an answer, for as far as it can be read: another firmware's greeting.
  const std::string& heard() const { return heard_; }

 private:
  bool ask(Question question, MessageType answer, Seconds within);

  BoardPort& port_;
  Decoder decoder_;
  std::string heard_;
};

}  // namespace passo
