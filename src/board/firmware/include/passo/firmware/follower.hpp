// Follower: the first control board's program, without its hardware. It receives step and direction signals and
// switches windings. A keypad moves the machine by hand. docs/follower.md describes it for the operator.
//
// One loop calls poll() as fast as it can. Each pass samples the clock lines once. A line that was low in the last
// sample and is high in this one makes a step, in the direction read with the last sample. So a direction must be set
// before its clock edge, and the longest time between two samples limits the step rate. Therefore all work that can
// wait (relay, keys, indicators) is done only in passes without a step, in pieces: one piece per millisecond.
//
// Hardware is a type with
//   uint8_t lines();                               bits 0 to 2: clock of X, Y, Z; 3 to 5: direction, 1 is down
//   bool relay_line();                             the computer requests the tool
//   void windings(uint8_t axis, uint8_t place);    switches to the pattern of the motor's WindingTable at this index
//   void relay(bool on);                           and its indicator
//   void indicators(bool automatic, bool manual);
//   static constexpr bool has_keypad;              false: always automatic, and the functions below are not needed
//   bool millisecond();                            a millisecond has passed since the last true
//   uint8_t rows();                                of the column driven low: a bit for each row with a pressed key
//   void draw_column(uint8_t column);              drives this column low and lets the others float
//   bool tool_button();
// With the customs of the first board, instead of indicators():
//   void leds(bool automatic, bool manual, bool raising);   neither mode is on before a mode key; `raising`: key 5 is
//   held
//   void light_relay_indicator();                 as manual mode begins; relay() switches it from then on
//
// Invariant: a motor's windings carry no current before its first step. Only an edge of the relay's line or the button
// closes the relay, never a reset or a change of mode. Portable.
#pragma once

#include <stdint.h>

#include "passo/firmware/jog_keys.hpp"
#include "passo/firmware/keypad.hpp"

namespace passo {

inline constexpr uint8_t follower_axes = 3;

// Keypad times, in scans of 5 ms each. A scan has five pieces: three columns, the keys, and the remaining work.
inline constexpr uint8_t looks_to_settle = 4;   // 20 ms
inline constexpr uint8_t looks_to_repeat = 80;  // 400 ms from a key's first step to its second
inline constexpr uint8_t looks_a_step = 2;      // 100 steps/s: motors start at that rate without a ramp

// What differs between boards. The first board waits for a mode key after its reset, repeats a held key every 20 ms,
// and raises Z by stepping backwards.
struct UsualCustoms {
  static constexpr bool is_first_board = false;
  static constexpr uint8_t looks_to_repeat = passo::looks_to_repeat;
  static constexpr uint8_t looks_a_step = passo::looks_a_step;
};
struct FirstBoardCustoms {
  static constexpr bool is_first_board = true;
  static constexpr uint8_t looks_to_repeat = 4;
  static constexpr uint8_t looks_a_step = 4;
};

template <class Hardware, class Customs = UsualCustoms>
class Follower {
 public:
  constexpr explicit Follower(Hardware& hardware) : hardware_(hardware) {}

  // Call once, before the first poll(). A line that is already high is not an edge.
  void begin() {
    lines_ = hardware_.lines();
    relay_line_ = hardware_.relay_line();
    if constexpr (Customs::is_first_board) {
      hardware_.leds(false, false, false);
    } else {
      hardware_.indicators(true, false);
    }
    if constexpr (Hardware::has_keypad) hardware_.draw_column(0);
  }

  void poll() {
    const uint8_t before = lines_;
    lines_ = hardware_.lines();
    const uint8_t risen = static_cast<uint8_t>(lines_ & ~before & 7);
    if (risen != 0 && follows()) return step(risen, static_cast<uint8_t>(before >> 3));
    follow_relay();
    if constexpr (Hardware::has_keypad) {
      if (hardware_.millisecond()) tick();
    }
  }

 private:
  // The computer's lines have an effect.
  bool follows() const {
    if constexpr (Customs::is_first_board) return trusted_ && !manual_;
    return !manual_;
  }

  void step(uint8_t axes, uint8_t down) {
    for (uint8_t axis = 0, bit = 1; axis < follower_axes; ++axis, bit = static_cast<uint8_t>(bit << 1)) {
      if ((axes & bit) == 0) continue;
      uint8_t place = places_[axis];
      if ((down & bit) != 0) {
        --place;
      } else {
        ++place;
      }
      places_[axis] = place;
      hardware_.windings(axis, place);
    }
  }

  void follow_relay() {
    const bool line = hardware_.relay_line();
    if (line == relay_line_) return;
    relay_line_ = line;
    if (follows()) set_relay(line);
  }
  void set_relay(bool on) {
    relay_ = on;
    hardware_.relay(on);
  }

  // Called every millisecond: does one fifth of a keypad scan.
  void tick() {
    const uint8_t piece = piece_++;
    if (piece < keypad_columns) {
      scan_.add(piece, hardware_.rows());
      hardware_.draw_column(piece_ < keypad_columns ? piece_ : uint8_t{0});
    } else if (piece == keypad_columns) {
      poll_keys();
    } else {
      piece_ = 0;
      poll_button();
      show_mode();
    }
  }

  void poll_keys() {
    const Key held = key_.value();
    key_.update(scan_.take());
    if (key_.value() != held) {
      press(key_.value());
    } else if (manual_ && key_.steady() && --wait_ == 0) {
      jog(held, Customs::looks_a_step);
    }
  }

  void poll_button() {
    const uint8_t pushed = button_.value();
    button_.update(hardware_.tool_button() ? 1 : 0);
    if (manual_ && button_.value() > pushed) set_relay(!relay_);
  }

  void press(Key key) {
    if (key == key_named('#')) set_manual(true);
    if (key == key_named('*')) set_manual(false);
    if (manual_) jog(key, Customs::looks_to_repeat);
  }
  void jog(Key key, uint8_t looks_until_next) {
    wait_ = looks_until_next;
    KeyMove move = jog_of_key.of[key];
    constexpr uint8_t z = 4;
    if constexpr (Customs::is_first_board) {
      if (move.steps == z) move.down = static_cast<uint8_t>(move.down ^ z);
    }
    step(move.steps, move.down);
  }
  // A mode key also confirms that the operator knows the machine position.
  void set_manual(bool manual) {
    if constexpr (Customs::is_first_board) {
      if (manual && !manual_) hardware_.light_relay_indicator();
    }
    manual_ = manual;
    trusted_ = true;
    if (!manual_ && !relay_line_) set_relay(false);
  }

  // After a reset the position is unknown, so the indicator blinks: 0.32 s on, 0.32 s off.
  void show_mode() {
    if constexpr (Customs::is_first_board) {
      hardware_.leds(follows(), manual_, manual_ && key_.value() == key_named('5'));
    } else {
      const bool lit = trusted_ || (++looks_ & 0x40) == 0;
      hardware_.indicators(lit && !manual_, lit && manual_);
    }
  }

  Hardware& hardware_;
  uint8_t lines_ = 0;
  uint8_t places_[follower_axes] = {};
  bool relay_line_ = false;
  bool relay_ = false;
  bool manual_ = false;
  bool trusted_ = false;
  uint8_t piece_ = 0;  // the next piece of a scan
  uint8_t looks_ = 0;
  uint8_t wait_ = 0;  // scans until a held key acts again
  KeypadScan scan_;
  Settled<looks_to_settle> key_{no_key};
  Settled<looks_to_settle> button_{0};
};

}  // namespace passo
