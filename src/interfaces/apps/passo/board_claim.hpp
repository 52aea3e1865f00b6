// BoardClaim: one program at a time drives a board. The claim is given back when its program ends, however it ends.
#pragma once

#include <string>
#include <utility>

#include "passo/base/result.hpp"
#include "passo/transport/board_address.hpp"

namespace passo {

class BoardClaim {
 public:
  // The error is a sentence that tells which process has the board.
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
