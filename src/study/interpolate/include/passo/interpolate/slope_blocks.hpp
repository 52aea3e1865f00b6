// SlopeBlocks: a line of two axes as blocks of pulses, one block for each step of the shorter axis. In the first
// octant, with q = length div height, a block is q div 2 plain steps, one diagonal and q − 1 − q div 2 plain steps.
// Each of the first (length mod height) blocks has one additional plain step.
//
// Between two diagonals there is only a countdown. The single division is before the first pulse. The remainder r is
// not spread over the line but used at its start, so the tool falls behind by up to r·(height − r)/length steps, and by
// half a step more within a block. Lengths up to 2³¹−1. Portable.
#pragma once

#include "passo/interpolate/line.hpp"

namespace passo {

template <class Length = uint32_t>
class SlopeBlocks {
 public:
  constexpr explicit SlopeBlocks(const int32_t (&distances)[2])
      : octant_(distances), left_(octant_.length), blocks_(octant_.height) {
    if (blocks_ == 0) return;
    pulses_ = static_cast<Length>(octant_.length / octant_.height);
    longer_ = static_cast<Length>(octant_.length % octant_.height);
    plain_ = static_cast<Length>(pulses_ / 2);
  }

  constexpr bool done() const { return left_ == 0; }
  constexpr Pulse next() {
    --left_;
    if (plain_ != 0 || blocks_ == 0) {
      --plain_;  // after the last diagonal this value is not used
      return octant_.along;
    }
    // The end of this block and the start of the next.
    plain_ = static_cast<Length>(pulses_ - 1);
    if (longer_ != 0) {
      ++plain_;
      --longer_;
    }
    --blocks_;
    return octant_.both;
  }

  // The number of plain steps before the next diagonal, and the number of blocks whose diagonal is still to come.
  constexpr uint32_t plain() const { return blocks_ == 0 ? left_ : plain_; }
  constexpr uint32_t blocks() const { return blocks_; }

 private:
  Octant<Length> octant_;
  Length left_;
  Length blocks_;      // number of remaining diagonals
  Length pulses_ = 0;  // q
  Length longer_ = 0;  // number of remaining blocks with an additional plain step
  Length plain_ = 0;   // number of plain steps before the next diagonal
};

}  // namespace passo
