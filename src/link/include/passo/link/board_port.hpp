// BoardPort: what a link sees of a board: a place for bytes, and bytes that come back.
//
// A virtual machine is one, and a line to one. Its time passes only in run().
#pragma once

#include <cstdint>
#include <span>

#include "passo/units/units.hpp"

namespace passo {

// Less than a tick of a board may be none: whoever waits for a time is there when so little is left, for a port may let
// none pass.
inline constexpr Seconds hardly_any{1e-6};

class BoardPort {
 public:
  virtual ~BoardPort() = default;

  virtual void receive(std::span<const std::uint8_t> bytes) = 0;
  // Lets time pass until the board has said something, but no more than `most`. False when it has said nothing: the
  // time is over; or, where that is infinite, it has come to rest and is silent.
  [[nodiscard]] virtual bool run(Seconds most) = 0;
  // Takes what the board has said since the last call; valid until the next call of any kind.
  virtual std::span<const std::uint8_t> replies() = 0;
  // The time on this side, from any start.
  virtual Seconds elapsed() const = 0;
};

}  // namespace passo
