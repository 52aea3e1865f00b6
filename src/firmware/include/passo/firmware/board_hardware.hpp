// What a Board needs of its hardware, and what it does where optional parts are missing. A type with
//   void step(uint8_t stepped, uint8_t directions);   motors in `stepped` make a step; those in `directions` step down
//   void outputs(const BoardOutputs&);
//   void send(uint8_t byte);                          to the host
//   void enable();                                    optional: lets the motors move again after a stop released them
//   bool switch_off(uint8_t switches);                optional: switches these outputs (bits of OutputSwitch) off, at
//                                                     rest; true if one was on
//   void watch();                                     optional: another input is watched now (Board::watched())
//   static void breathe();                            optional: called between two pieces of work
//   uint8_t room();                                   optional: the number of bytes that may be sent now
//   bool has_encoder(); SpindleCount spindle();       optional, both: an encoder at the spindle
//
// Portable.
#pragma once

#include <stdint.h>

namespace passo {

// Called between two pieces of work: hardware with a small buffer reads its line then.
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
