// The hardware interface of a Board, and the default behaviour of its optional parts. Hardware is a type with
//   void step(uint8_t stepped, uint8_t directions);   motors in `stepped` make a step; those in `directions` step down
//   void outputs(const BoardOutputs&);
//   void send(uint8_t byte);                          sends a byte to the host; or
//   uint8_t* space(uint8_t size); void put(uint8_t);  returns the buffer for the next frame, of at most `size` bytes;
//                                                     sends it
//   void enable();                                    optional: enables the drivers again after a stop released them
//   bool switch_off(uint8_t switches);                optional: switches these outputs (bits of OutputSwitch) off, at
//                                                     standstill; true if one was on
//   void watch();                                     optional: the watched input has changed (Board::watched())
//   static void release_capture();                    optional: the position of the capture has been read
//   PinSetup set_up(const PinSetup&);                 optional: applies the supported part while stopped; returns it
//   uint8_t drivers_rest(); void release();           optional, both: that part of the setup; switches the drivers off
//   bool can_watch(uint8_t limits);                   optional: whether it can watch several limit switches at once
//   static void breathe();                            optional: called between two pieces of work
//   static void keep_up();                            optional: breathe(), and makes events for the timer
//   static void slice();                              optional: keep_up() if needed; called between two bytes of a
//                                                     frame
//   static int32_t high_product(int32_t, int32_t);    optional: a faster one than that of wire/segment_parts.hpp
//   uint8_t room();                                   optional: the number of bytes that may be sent now
//   bool has_encoder(); SpindleCount spindle();       optional, both: a spindle encoder
//   bool has_handwheel(); HandwheelCount handwheel(); optional, both: a handwheel at its pins
//
// Portable.
#pragma once

#include <stdint.h>

#include "passo/firmware/host_timeout.hpp"
#include "passo/wire/handwheel_count.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// Called between two pieces of work: hardware with a small receive buffer reads it then. Hardware may also have its own
// multiplication.
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

// Called at each byte of a frame that is being composed: like keep_up(), but cheap if there is nothing to do.
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

// Called during long work, on chips that compute events ahead of time. Items may end during the call, so values to be
// reported must be read before.
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
[[gnu::always_inline]] inline bool has_handwheel(Hardware& hardware) {
  if constexpr (requires { hardware.has_handwheel(); }) return hardware.has_handwheel();
  return false;
}

template <class Hardware>
[[gnu::always_inline]] inline void enable(Hardware& hardware) {
  BreathOf<Hardware>{}();
  if constexpr (requires { hardware.enable(); }) hardware.enable();
  BreathOf<Hardware>{}();
}

// Switches these outputs off. Returns true if one of them was on.
template <class Hardware>
[[gnu::always_inline]] inline bool switch_off(Hardware& hardware, uint8_t switches) {
  if constexpr (requires { hardware.switch_off(switches); }) return switches != 0 && hardware.switch_off(switches);
  return false;
}

// Switches the drivers off if the host has been silent for the time in the setup. Returns true if it has been.
template <class Hardware>
[[gnu::always_inline]] inline bool lets_go(Hardware& hardware, HostTimeout& silence) {
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

// From a capture on, the chip may hold its items back until their position is read. Composing the answer takes long.
template <class Hardware>
[[gnu::always_inline]] inline void release_capture(Hardware& hardware) {
  if constexpr (requires { hardware.release_capture(); }) hardware.release_capture();
}

// Whether the limit switches in these bits can be captured together.
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
