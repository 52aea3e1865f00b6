// Tells a switch that has moved from noise on its wire: a change counts only when it has lasted for a time. Portable.
#pragma once

#include <stdint.h>

namespace passo {

// The inputs now, as bits of BoardInput. Of those in `filtered`, one that differs from `before` counts only if it keeps
// doing so for that many microseconds; meanwhile this function looks at the pins again and again. So it takes time only
// where a switch has truly moved. Chip has
//   static uint16_t inputs();            bits of BoardInput, set where a switch is on
//   static uint8_t half_microseconds();  a clock that comes round; a look may not take as long as that
//   static void breathe();               called between two looks
template <class Chip>
uint16_t settled_inputs(uint16_t before, uint16_t filtered, uint8_t microseconds) {
  const uint16_t first = Chip::inputs();
  if (microseconds == 0) return first;
  uint16_t moved = static_cast<uint16_t>((first ^ before) & filtered);
  uint16_t left = static_cast<uint16_t>(2 * microseconds);
  for (uint8_t last = Chip::half_microseconds(); moved != 0;) {
    Chip::breathe();
    const uint8_t now = Chip::half_microseconds();
    const uint8_t passed = static_cast<uint8_t>(now - last);
    last = now;
    moved = static_cast<uint16_t>(moved & (Chip::inputs() ^ before));
    if (passed >= left) break;
    left = static_cast<uint16_t>(left - passed);
  }
  return static_cast<uint16_t>((first & ~filtered) | ((before & filtered) ^ moved));
}

}  // namespace passo
