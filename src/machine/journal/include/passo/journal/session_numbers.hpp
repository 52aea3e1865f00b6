// SessionNumbers: the numbers that identify a board, from before a session's hello until the next one.
//
// A host stores them before the handshake. Then the host may be killed at any instant: the next host can decide from
// the board's status whether the numbers belong to that board.
#pragma once

#include <cstdint>

#include "passo/wire/message.hpp"

namespace passo {

struct SessionNumbers {
  enum class Stage : std::uint8_t {
    another,         // the board was reset, or was connected to another session
    before_hello,    // the board is in its state before this session
    before_session,  // the board has received this session's hello
    in_session,
  };

  // The board's numbers before this session's hello, and its new numbers.
  std::uint16_t session_before = 0;
  std::uint16_t executed_before = 0;  // number of an item
  std::uint8_t greeting = 0;          // 0: no hello, the board receives only the session's number
  std::uint16_t session = 0;          // not 0

  // `may_be_early`: the board may not have received the session number yet, because nothing was sent in the session.
  Stage stage_of(const BoardStatus& status, bool may_be_early) const;
  friend bool operator==(const SessionNumbers&, const SessionNumbers&) = default;
};

}  // namespace passo
