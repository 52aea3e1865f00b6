// BoardPlay: the first board in virtual time: its program (firmware/follower.hpp with the first board's customs), its
// keypad, and the rotors of its three motors. The lab's part Board plays it. Unlike the lab's other answers it keeps a
// state.
//
// The computer's side is a byte of levels, as on the board's inputs: bits 0 to 2 clock X, Y, Z, bits 3 to 5 direction,
// bit 6 the tool's line. A clock generator, as the computer's program has one, drives some of the clock lines.
//
// The rotors are ideal: each is at the angle of the field, or, without current, where it was. A reset clears the
// board's counters but turns no rotor. So the first step after a reset moves a rotor to the nearest position of the new
// pattern, which may be up to two steps away: why the machine position is not trusted after an emergency stop.
//
// The loop turns every 100 µs of virtual time; the speed of the real loop is measured elsewhere (docs/follower.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/firmware/follower.hpp"
#include "passo/firmware/winding_table.hpp"

namespace passo {

// The board's pins, as Follower uses them: what is pressed and driven, and what the board makes of it.
struct BoardPins {
  static constexpr bool has_keypad = true;
  static constexpr std::uint8_t tool_line = 1 << 6;

  std::uint8_t levels = 0;    // of the computer's lines
  std::uint16_t pressed = 0;  // a bit for each key, in the order 1 2 3 4 5 6 7 8 9 * 0 #
  bool pushed = false;        // the tool button
  std::int64_t now_us = 0;

  std::uint8_t patterns[follower_axes] = {};
  std::int64_t rotors[follower_axes] = {};  // full steps
  bool relay_closed = false;
  bool is_relay_lit = false;  // RE2
  bool is_automatic = false;
  bool is_manual = false;
  bool is_raising = false;

  std::uint8_t lines() const { return levels; }
  bool relay_line() const { return (levels & tool_line) != 0; }
  bool tool_button() const { return pushed; }
  std::uint8_t rows() const;
  void draw_column(std::uint8_t column) { column_ = column; }
  bool millisecond();
  void windings(std::uint8_t axis, std::uint8_t place);
  void relay(bool on) { relay_closed = is_relay_lit = on; }
  void light_relay_indicator() { is_relay_lit = true; }
  void leds(bool automatic, bool manual, bool raising);
  // All outputs float; the clock of the milliseconds begins anew.
  void float_outputs();

 private:
  std::uint8_t column_ = 0;
  std::int64_t next_us_ = 1000;
};

class BoardPlay {
 public:
  static constexpr std::int64_t turn_us = 100;
  static constexpr std::int64_t longest_run_us = 1'000'000;

  BoardPlay() { reset(false); }
  BoardPlay(const BoardPlay&) = delete;  // the program keeps a reference to the pins
  BoardPlay& operator=(const BoardPlay&) = delete;

  // The emergency button: all outputs float while it is pressed, and then the program begins anew.
  void reset(bool pressed);
  void set_lines(std::uint8_t levels) { pins_.levels = levels; }
  void set_keys(std::uint16_t pressed) { pins_.pressed = pressed; }
  void set_button(bool pushed) { pins_.pushed = pushed; }
  // A square wave on the clock lines of `axes` (bits 0 to 2), as the computer makes it: each level lasts `half_us`, at
  // least two turns of the loop. `idle`: the lines that are high between pulses, because they are inverted. The clock
  // ends after `pulses`, or never if they are negative. 0 axes: it ends at once, and its lines return to idle. A line
  // that is not `wired` never changes: its pulses are counted, and no motor steps.
  void set_clock(std::uint8_t axes, std::int64_t half_us, std::int64_t pulses, std::uint8_t idle = 0,
                 std::uint8_t wired = 0b111);
  // Lets time pass, at most longest_run_us.
  void run(std::int64_t microseconds);

  // One JSON text: the lines, whether the clock runs, how many pulses it has ever made, and all that the board shows.
  std::string answer() const;

 private:
  void advance_clock();
  // The level of a pulse, or of the time between pulses, on the wired clock lines of `axes`.
  void drive_clock(unsigned axes, bool high);

  BoardPins pins_;
  std::optional<Follower<BoardPins, FirstBoardCustoms>> follower_;  // none while the emergency button is pressed
  std::uint8_t clock_axes_ = 0;
  std::uint8_t idle_ = 0;
  std::uint8_t wired_ = 0b111;
  bool is_high_ = false;  // within a pulse
  std::int64_t half_us_ = 0;
  std::int64_t next_edge_us_ = 0;
  std::int64_t pulses_left_ = 0;
  std::int64_t pulses_made_ = 0;
};

}  // namespace passo
