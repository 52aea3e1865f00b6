// KnownWorkPosition: tracks which work coordinates of the current position are determined by the program itself. An
// axis is known once the program has specified its absolute position; a shift of the work zero, or a move of the axis
// in machine coordinates, makes it unknown again. Private to probing/.
#pragma once

#include <cstdint>

#include "passo/geometry/axes.hpp"

namespace passo {

// What is known about Z. of_machine: at the start, and after G53, G28 and G30; the program has not specified a work Z
// since, and moves stay unchanged until it does. of_work: moves are levelled, but the value of Z is unknown (the zero
// was shifted, or only distances were given), so the height is added as a distance. known: moves are levelled, with a
// known value of Z.
enum class LevelHeight : std::uint8_t { of_machine, of_work, known };

class KnownWorkPosition {
 public:
  bool has(Axis axis) const { return known_.has(axis); }
  bool has_all(AxisSet axes) const { return (axes.bits() & ~known_.bits()) == 0; }
  LevelHeight height() const { return height_; }

  // Notes a move in work coordinates, with absolute positions for these axes. `names_height`: Z is specified, as a
  // position or a distance.
  void note_move(AxisSet absolute, bool names_height) {
    known_ = AxisSet(static_cast<std::uint16_t>(known_.bits() | absolute.bits()));
    if (!names_height) return;
    const bool is_known = height_ == LevelHeight::known || absolute.has(Axis::z);
    height_ = is_known ? LevelHeight::known : LevelHeight::of_work;
  }
  // Notes a cycle at a position in X and Y, which ends at such a height.
  void note_cycle(LevelHeight ends_at) {
    known_.add(Axis::x);
    known_.add(Axis::y);
    height_ = ends_at;
    if (height_ == LevelHeight::known) known_.add(Axis::z);
  }
  // Marks these axes as unknown.
  void lose(AxisSet axes) {
    known_ = AxisSet(static_cast<std::uint16_t>(known_.bits() & ~axes.bits()));
    if (axes.has(Axis::z) && height_ == LevelHeight::known) height_ = LevelHeight::of_work;
  }
  // Notes that Z moved to a position in machine coordinates.
  void leave_work() { height_ = LevelHeight::of_machine; }

 private:
  AxisSet known_;
  LevelHeight height_ = LevelHeight::of_machine;
};

}  // namespace passo
