// SaidPlace: what a program has said of where it is in the work. An axis that it has named by a place is known until
// the zero of the work changes, or the machine moves the axis by its own coordinates. Private to probing/.
#pragma once

#include <cstdint>

#include "passo/geometry/axes.hpp"

namespace passo {

// Where Z is. Of the machine: at the start, and after G53, G28 and G30. The program has said nothing of the work's Z,
// and moves stay as they are until it does. Of the work: moves are levelled. Where the number of Z is not known (the
// zero has changed, or only ways were given), the height is added as a way.
enum class LevelHeight : std::uint8_t { of_machine, of_work, known };

class SaidPlace {
 public:
  bool has(Axis axis) const { return known_.has(axis); }
  bool has_all(AxisSet axes) const { return (axes.bits() & ~known_.bits()) == 0; }
  LevelHeight height() const { return height_; }

  // A move in the work, to a place along these axes. `names_height`: it goes to a place in Z, or some way along Z.
  void note_move(AxisSet absolute, bool names_height) {
    known_ = AxisSet(static_cast<std::uint16_t>(known_.bits() | absolute.bits()));
    if (!names_height) return;
    const bool is_known = height_ == LevelHeight::known || absolute.has(Axis::z);
    height_ = is_known ? LevelHeight::known : LevelHeight::of_work;
  }
  // A cycle at a place in X and Y, which ends at such a height.
  void note_cycle(LevelHeight ends_at) {
    known_.add(Axis::x);
    known_.add(Axis::y);
    height_ = ends_at;
    if (height_ == LevelHeight::known) known_.add(Axis::z);
  }
  // What was said of these axes counts no more.
  void lose(AxisSet axes) {
    known_ = AxisSet(static_cast<std::uint16_t>(known_.bits() & ~axes.bits()));
    if (axes.has(Axis::z) && height_ == LevelHeight::known) height_ = LevelHeight::of_work;
  }
  // Z went to a place of the machine.
  void leave_work() { height_ = LevelHeight::of_machine; }

 private:
  AxisSet known_;
  LevelHeight height_ = LevelHeight::of_machine;
};

}  // namespace passo
