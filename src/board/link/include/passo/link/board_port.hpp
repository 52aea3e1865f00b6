// BoardPort: the view that a link has of a board. The port takes bytes, and gives the bytes that come back.
//
// A virtual machine is a port, and so is a line to one. The port's time passes only in run().
#pragma once

#include <cstdint>
#include <span>

#include "passo/units/units.hpp"

namespace passo {

// A wait is over when no more than this time is left. A port may let no time pass for less than a tick of the board, so
// waiting for the rest might never end.
inline constexpr Seconds hardly_any{1e-6};

class BoardPort {
 public:
  virtual ~BoardPort() = default;

  virtual void receive(std::span<const std::uint8_t> bytes) = 0;
  // Lets time pass until the board has said something, but no more than `most`. False: the board has said nothing, and
  // the time is over. With an infinite `most`, false: the board has come to rest and is silent.
  [[nodiscard]] virtual bool run(Seconds most) = 0;
  // Takes what the board has said since the last call. The bytes are valid until the next call of any kind.
  virtual std::span<const std::uint8_t> replies() = 0;
  // True: the other side has closed the line, and has said nothing since.
  virtual bool hung_up() const { return false; }
  // The time on this side, from any start.
  virtual Seconds elapsed() const = 0;
};

}  // namespace passo
