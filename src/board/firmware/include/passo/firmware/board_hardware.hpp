// What a Board needs of its hardware, and what it does where optional parts are missing. A type with
//   void step(uint8_t stepped, uint8_t directions);   motors in `stepped` make a step; those in `directions` step down
//   void outputs(const BoardOutputs&);
//   void send(uint8_t byte);                          to the host; or
//   uint8_t* space(uint8_t size); void put(uint8_t);  where the next frame, of at most `size` bytes, is put together;
//                                                     sends it
//   void enable();                                    optional: lets the motors move again after a stop released them
//   bool switch_off(uint8_t switches);                optional: switches these outputs (bits of OutputSwitch) off, at
//                                                     rest; true if one was on
//   void watch();                                     optional: another input is watched now (Board::watched())
//   static void release_capture();                    optional: the place of the capture is known now
//   PinSetup set_up(const PinSetup&);                 optional: applies what it can, at rest, and returns that
//   uint8_t drivers_rest(); void release();           optional, both: that part of the setup; lets the motors go
//   bool can_watch(uint8_t limits);                   optional: whether it can watch several limit switches at once
//   static void breathe();                            optional: called between two pieces of work
//   static void keep_up();                            optional: breathes, and makes events for the timer
//   static void slice();                              optional: the same where it is needed; between two bytes of a
//                                                     frame
//   static int32_t high_product(int32_t, int32_t);    optional: that of wire/segment_parts.hpp, faster
//   uint8_t room();                                   optional: the number of bytes that may be sent now
//   bool has_encoder(); SpindleCount spindle();       optional, both: an encoder at the spindle
//
// Portable.
#pragma once

#include <stdint.h>

#include "passo/firmware/host_silence.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// Called between two pieces of work: hardware with a small buffer reads its line then. Hardware may have a product of
// its own too.
template <class Hardware>
struct BreathOf {
  [[gnu::always_inline]] static int32_t high_product(int32_t a, int32_t b) requires requires {
    Hardware::high_product(a, b);
  }
  { return Hardware::high_product(a, b); }
  [[gnu::always_inline]] void operator()() const {
    if constexpr (requires { Hardware::breathe(); }) Hardware::breathe();
  }
};

// Called at each byte of a frame that is put together: like keep_up(), but cheap where there is nothing to do.
template <class Hardware>
struct SliceOf {
  [[gnu::always_inline]] void operator()() const {
    if constexpr (requires { Hardware::slice(); }) {
      Hardware::slice();
    } else {
      BreathOf<Hardware>{}();
    }
  }
};

// Called amid long work, where a chip makes events ahead of time. Items may end: what is told must be known already.
template <class Hardware>
[[gnu::always_inline]] inline void keep_up(Hardware&) {
  if constexpr (requires { Hardware::keep_up(); }) {
    Hardware::keep_up();
  } else {
    BreathOf<Hardware>{}();
  }
}

template <class Hardware>
[[gnu::always_inline]] inline bool has_encoder(Hardware& hardware) {
  if constexpr (requires { hardware.has_encoder(); }) return hardware.has_encoder();
  return false;
}

template <class Hardware>
[[gnu::always_inline]] inline void enable(Hardware& hardware) {
  BreathOf<Hardware>{}();
  if constexpr (requires { hardware.enable(); }) hardware.enable();
  BreathOf<Hardware>{}();
}

// True if one of these outputs was on.
template <class Hardware>
[[gnu::always_inline]] inline bool switch_off(Hardware& hardware, uint8_t switches) {
  if constexpr (requires { hardware.switch_off(switches); }) return switches != 0 && hardware.switch_off(switches);
  return false;
}

// Lets the motors go if the host has been silent for as long as the setup says. True if it does.
template <class Hardware>
[[gnu::always_inline]] inline bool lets_go(Hardware& hardware, HostSilence& silence) {
  if constexpr (requires { hardware.release(); }) {
    if (!silence.is_over(hardware.drivers_rest())) return false;
    hardware.release();
    silence.set_released();
    return true;
  }
  return false;
}

template <class Hardware>
[[gnu::always_inline]] inline PinSetup set_up(Hardware& hardware, const PinSetup& setup) {
  if constexpr (requires { hardware.set_up(setup); }) return hardware.set_up(setup);
  return {};
}

// The chip may hold its items back from a capture on, until their place is read. Putting the answer together takes
// long.
template <class Hardware>
[[gnu::always_inline]] inline void release_capture(Hardware& hardware) {
  if constexpr (requires { hardware.release_capture(); }) hardware.release_capture();
}

// Whether the switches of these bits can capture together.
template <class Hardware>
[[gnu::always_inline]] inline bool can_watch(Hardware& hardware, uint8_t limits) {
  if ((limits & (limits - 1)) == 0) return true;
  if constexpr (requires { hardware.can_watch(limits); }) return hardware.can_watch(limits);
  return false;
}

template <class Hardware>
[[gnu::always_inline]] inline bool has_room(Hardware& hardware, uint8_t bytes) {
  if constexpr (requires { hardware.room(); }) return hardware.room() >= bytes;
  return true;
}

}  // namespace passo
