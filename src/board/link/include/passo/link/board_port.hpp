// BoardPort: the byte stream to and from a board, as the link sees it.
//
// A simulated machine is a port, and so is a serial or TCP connection. The port's time passes only in run().
#pragma once

#include <cstdint>
#include <span>

#include "passo/units/units.hpp"

namespace passo {

// A wait ends when at most this time is left, because a port may not be able to wait for less than a tick.
inline constexpr Seconds hardly_any{1e-6};

class BoardPort {
 public:
  virtual ~BoardPort() = default;

  virtual void receive(std::span<const std::uint8_t> bytes) = 0;
  // Lets time pass until the board has sent something, but at most `most`. Returns false if the time is over and the
  // board has sent nothing; with an infinite `most`, if the board has stopped and is silent.
  [[nodiscard]] virtual bool run(Seconds most) = 0;
  // Returns what the board has sent since the last call. The bytes are valid until the next call of any function.
  virtual std::span<const std::uint8_t> replies() = 0;
  // Returns true if the other side has closed the connection, and all its bytes have been read.
  virtual bool hung_up() const { return false; }
  // The time on this side, from an arbitrary zero.
  virtual Seconds elapsed() const = 0;
};

}  // namespace passo
