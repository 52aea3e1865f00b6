// SessionNumbers: the numbers by which a board is recognised, from before a session's hello until the next one.
//
// A host stores them before the handshake. Then the host may be killed at any instant, and the next host can tell from
// the board's status whether the board is the one that was written of.
#pragma once

#include <cstdint>

#include "passo/wire/message.hpp"

namespace passo {

struct SessionNumbers {
  enum class Stage : std::uint8_t {
    another,         // the board was reset, or has heard of another session
    before_hello,    // the board is as it was before this session
    before_session,  // the board has heard this session's hello
    in_session,
  };

  // The board's numbers before this session's hello, and its new numbers.
  std::uint16_t session_before = 0;
  std::uint16_t executed_before = 0;  // number of an item
  std::uint8_t greeting = 0;          // 0: no hello, the board hears only the session's number
  std::uint16_t session = 0;          // not 0

  // `may_be_early`: the board may not have heard of the session yet, for nothing was sent in it.
  Stage stage_of(const BoardStatus& status, bool may_be_early) const;
  friend bool operator==(const SessionNumbers&, const SessionNumbers&) = default;
};

}  // namespace passo
