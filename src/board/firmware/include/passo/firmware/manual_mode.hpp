// ManualMode: the operator moves the machine with the keypad of a Board. `#` enters the mode, `*` leaves it, both only
// at standstill.
//
// A short press of a key makes some steps. A key held for 0.4 s starts continuous motion, up a ramp to the highest
// speed. When the key is released, the motion decelerates on the same ramp. Jogging uses the board's own list and
// player, so every step is counted and switches act as always. A host receives the error `manual`. Its motion is not
// executed until its next hello after `*`.
//
// Hardware is a type with
//   static uint8_t rows();                                a bit for each row with a pressed key, in the low column
//   static void draw_column(uint8_t column);              drives this column low and lets the others float
//   static bool tool_button();
//   static void indicators(bool automatic, bool manual);
//
// Invariant: while a key is held, the list holds some pieces ahead. After its release the deceleration ramp follows
// them. Portable.
#pragma once

#include <stdint.h>

#include "passo/firmware/jog_keys.hpp"
#include "passo/firmware/jog_ramp.hpp"
#include "passo/firmware/keypad.hpp"
#include "passo/wire/message.hpp"

namespace passo {

template <class Hardware, class Board>
class ManualMode {
 public:
  constexpr ManualMode(Board& board, const JogRamp& ramp) : board_(board), ramp_(ramp) {}

  // Call once, before the first tick.
  void begin() {
    Hardware::draw_column(0);
    Hardware::indicators(true, false);
  }

  // Call about every 4 milliseconds: scans one column.
  void tick() {
    scan_.add(column_, Hardware::rows());
    board_.breathe();
    column_ = column_ + 1 < keypad_columns ? static_cast<uint8_t>(column_ + 1) : uint8_t{0};
    Hardware::draw_column(column_);
    if (column_ == 0) poll();
  }

  // Call as often as possible: adds the next pieces of motion.
  void feed() {
    if (!board_.manual() || (!runs_ && stage_ == 0) || board_.size() >= pieces_ahead) return;
    if (!runs_) return slow_down();
    if (stage_ == jog_stages) return play(ramp_.piece, ramp_.shortest, 0);
    const JogRamp::Stage& stage = ramp_.stages[stage_++];
    play(stage.events, stage.interval, stage.change);
  }

  // Call when a switch has stopped the motors instantly.
  void stopped() {
    stage_ = 0;
    runs_ = waits_ = false;
  }

 private:
  // A scan takes three ticks, 12 ms.
  static constexpr uint8_t looks_to_settle = 2;  // 24 ms
  static constexpr uint8_t looks_to_repeat = 33;
  static constexpr uint8_t pieces_ahead = 3;
  static constexpr uint16_t stopping = input_emergency_stop | 0xff * input_limit;

  [[gnu::noinline]] void poll() {
    board_.breathe();
    const Key held = key_.value();
    key_.update(scan_.take());
    if (key_.value() != held) press(key_.value());
    board_.breathe();
    if (!key_.steady()) runs_ = waits_ = false;
    if (waits_ && board_.rests()) start();
    if (left_ != 0 && key_.steady() && --left_ == 0) runs_ = true;
    board_.breathe();
    poll_button();
    board_.breathe();
    Hardware::indicators(!board_.manual(), board_.manual());
  }

  [[gnu::noinline]] void press(Key key) {
    runs_ = waits_ = false;
    left_ = 0;
    if (key == key_named('#') && !board_.manual() && may_move()) board_.begin_manual();
    if (key == key_named('*') && board_.manual() && board_.rests()) {
      set_tool(false);
      board_.end_manual();
    }
    waits_ = board_.manual() && jog_of_key.of[key].steps != 0;
  }
  bool may_move() const { return board_.rests() && (board_.inputs() & stopping) == 0; }

  [[gnu::noinline]] void start() {
    waits_ = false;
    if (!may_move()) return;
    jog_ = jog_of_key.of[key_.value()];
    left_ = looks_to_repeat;
    play(ramp_.tap, ramp_.longest(), 0);
  }
  [[gnu::noinline]] void slow_down() {
    const JogRamp::Stage& stage = ramp_.stages[--stage_];
    const uint32_t gained = static_cast<uint32_t>(stage.change) * static_cast<uint16_t>(stage.events - 1);
    play(stage.events, stage.interval + gained, -stage.change);
  }
  [[gnu::noinline]] void play(uint16_t events, uint32_t interval, int32_t change) {
    // The increments are 0 and flipped: every event makes a step, and the motors' fractions stay unchanged.
    typename Board::Segment segment;
    segment.events = events;
    segment.directions = jog_.down;
    segment.flips = jog_.steps;
    segment.interval = interval;
    segment.change = change;
    board_.jog(segment);
  }

  void poll_button() {
    const uint8_t pushed = button_.value();
    button_.update(Hardware::tool_button() ? 1 : 0);
    if (board_.manual() && board_.rests() && button_.value() > pushed) set_tool(!tool_);
  }
  void set_tool(bool on) {
    if (on == tool_) return;
    tool_ = on;
    board_.switch_outputs({.switches = on ? uint8_t{spindle_on} : uint8_t{0}});
  }

  Board& board_;
  const JogRamp& ramp_;
  KeypadScan scan_;
  Settled<looks_to_settle> key_{no_key};
  Settled<looks_to_settle> button_{0};
  uint8_t column_ = 0;
  uint8_t left_ = 0;    // scans until a held key starts continuous motion
  uint8_t stage_ = 0;   // the next stage of the ramp during acceleration
  bool waits_ = false;  // a key waits until the motors have stopped
  bool runs_ = false;   // a key is held, and the motors run
  bool tool_ = false;
  KeyMove jog_;
};

}  // namespace passo
