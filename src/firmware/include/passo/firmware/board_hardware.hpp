// What a Board needs of the hardware that it runs on, and what it does where some of it is left out. A type with
//   void step(uint8_t stepped, uint8_t directions);   the motors in `stepped` make a step; those in `directions`, down
//   void outputs(const BoardOutputs&);
//   void send(uint8_t byte);                          to the host
//   void enable();                                    may be left out: the motors are to move, though a stop let go of
//                                                     them
//   void watch();                                     may be left out: what is watched is another (Board::watched())
//   static void breathe();                            may be left out: called between two pieces of work
//   uint8_t room();                                   may be left out: how many bytes may be sent now
//   bool has_encoder(); SpindleCount spindle();       may be left out, both: of an encoder at the spindle
//
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

// Between two pieces of work: hardware with a small buffer looks at its line.
template <class Hardware>
struct BreathOf {
  [[gnu::always_inline]] void operator()() const {
    if constexpr (requires { Hardware::breathe(); }) Hardware::breathe();
  }
};

template <class Hardware>
[[gnu::always_inline]] inline bool has_encoder(Hardware& hardware) {
  if constexpr (requires { hardware.has_encoder(); }) return hardware.has_encoder();
  return false;
}

template <class Hardware>
[[gnu::always_inline]] inline bool has_room(Hardware& hardware, uint8_t bytes) {
  if constexpr (requires { hardware.room(); }) return hardware.room() >= bytes;
  return true;
}

}  // namespace passo
