// BoardClaim: a lock that lets only one program at a time drive a board. It is released when its program ends in any
// way.
#pragma once

#include <string>
#include <utility>

#include "passo/base/result.hpp"
#include "passo/transport/board_address.hpp"

namespace passo {

class BoardClaim {
 public:
  // The error is a sentence that identifies the process with the lock.
  static Result<BoardClaim, std::string> acquire(const BoardAddress& address);

  BoardClaim(BoardClaim&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  BoardClaim& operator=(BoardClaim&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~BoardClaim();

 private:
  explicit BoardClaim(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace passo
