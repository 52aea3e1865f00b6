// BoardPort: what a link sees of a board: a place for bytes, and bytes that come back.
//
// A virtual machine is one. Its time passes only in run().
#pragma once

#include <cstdint>
#include <span>

namespace passo {

class BoardPort {
 public:
  virtual ~BoardPort() = default;

  virtual void receive(std::span<const std::uint8_t> bytes) = 0;
  // Lets the board go on until it has something to say. False when it has come to rest and is silent.
  [[nodiscard]] virtual bool run() = 0;
  // Takes what the board has said since the last call; valid until the next call of any kind.
  virtual std::span<const std::uint8_t> replies() = 0;
};

}  // namespace passo
