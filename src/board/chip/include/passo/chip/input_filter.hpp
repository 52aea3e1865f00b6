// Distinguishes a switch change from noise on its wire: a change counts only after it has lasted for a given time.
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

// Chip has
//   static uint16_t inputs();       bits of BoardInput, set where a switch is on
//   static uint8_t microseconds();  a clock that wraps after 128 µs; the time between two samples must be shorter
//   static uint8_t filter();        microseconds for which a switch must stay in its new state
//   static void breathe();          called after each sample

// Returns those inputs in `moved` that stay different from `before` for that many microseconds. Samples the pins
// repeatedly, so it takes time only where a switch has truly changed. A separate function, because a chip has few
// registers.
template <class Chip>
[[gnu::noinline]] uint16_t stay_moved(uint16_t before, uint16_t moved, uint8_t microseconds) {
  for (uint8_t last = Chip::microseconds(); moved != 0;) {
    Chip::breathe();
    const uint8_t passed = static_cast<uint8_t>(Chip::microseconds() - last) & 0x7f;
    last = static_cast<uint8_t>(last + passed);
    moved = static_cast<uint16_t>(moved & (Chip::inputs() ^ before));
    if (passed >= microseconds) break;
    microseconds = static_cast<uint8_t>(microseconds - passed);
  }
  return moved;
}

// Returns the present inputs. An input in `filtered` that differs from `before` counts as changed only if it stays so.
template <class Chip>
uint16_t settled_inputs(uint16_t before, uint16_t filtered) {
  const uint16_t now = Chip::inputs();
  Chip::breathe();
  const uint16_t moved = static_cast<uint16_t>((now ^ before) & filtered);
  return static_cast<uint16_t>(now ^ moved ^ stay_moved<Chip>(before, moved, Chip::filter()));
}

}  // namespace passo
