// PressedButtons: finds out that a button of the board was pressed, from the inputs of the status. Private to api/.
//
// A button counts as pressed if it closes after it was open for `open_for`: contacts that bounce press once. One that
// is held from the beginning, or since forget(), counts only after it was released. A board may report its inputs late,
// so nothing counts for `settles_for` after that.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "passo/units/units.hpp"

namespace passo {

class PressedButtons {
 public:
  static constexpr Seconds open_for{0.05};
  static constexpr Seconds settles_for{1};

  // Returns the inputs, as bits of BoardInput, that were pressed since the last call.
  std::uint16_t update(std::uint16_t inputs, Seconds now) {
    unsigned pressed = 0;
    if (!begun_at_) begun_at_ = now;
    const bool is_settled = now - *begun_at_ >= settles_for;
    for (unsigned bit = 0; bit < opened_at_.size(); ++bit) {
      std::optional<Seconds>& opened_at = opened_at_[bit];
      if ((inputs >> bit & 1U) == 0) {
        if (!opened_at) opened_at = now;
      } else {
        if (is_settled && opened_at && now - *opened_at >= open_for) pressed |= 1U << bit;
        opened_at.reset();
      }
    }
    return static_cast<std::uint16_t>(pressed);
  }
  void forget() { *this = {}; }

 private:
  std::optional<Seconds> begun_at_;
  std::array<std::optional<Seconds>, 16> opened_at_;  // empty: the input is closed, or not known yet
};

}  // namespace passo
