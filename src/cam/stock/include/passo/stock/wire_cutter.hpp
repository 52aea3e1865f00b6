// WireCutter: simulates how the moves of a program melt a block of foam with a hot wire.
//
// The wire is straight, from the left tower (X Y) to the right one (U V, or also X Y). In each slice of the block it
// follows a separate path, and melts half of its kerf on both sides. The kerf depends on the speed in that slice. The
// melted volume is the union of these slots: exact along lines; arcs become chords within a tenth of a cell.
//
// Slices are independent, and are distributed to threads. Cells take the minimum of the distances. The result is
// therefore the same, bit for bit, for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "passo/geometry/curve.hpp"
#include "passo/stock/foam_block.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct WireMove {
  std::uint32_t line = 0;  // line of the program
  bool rapid = false;
  Seconds time{0};  // duration; 0: unknown, and the minimum kerf is used
};

// The effect of a move. Volume in mm³, lengths in mm.
struct WireCut {
  WireMove move;
  double volume = 0;
  double least_kerf = 0;  // minimum over the block's slices
  double most_kerf = 0;
  Vector3 place{};  // a melted point, if there is one
};

struct WireCutterOptions {
  bool has_four_axes = false;  // the right end is driven by U V
  double span = 0;             // Z of the right tower, mm; used with four axes
  // Returns the kerf, mm, of a move at this speed, mm/s, with this duration, s. Infinite speed: unknown.
  std::function<double(double speed, double time)> kerf = {};
  unsigned threads = 1;
};

class WireCutter {
 public:
  using Watcher = std::function<void(const WireCut&)>;

  // The foam must outlive the cutter. `watcher` may be empty.
  WireCutter(FoamBlock& foam, const WireCutterOptions& options, Watcher watcher);
  ~WireCutter();

  // Cuts along a curve in machine coordinates; `zero`: the position of the program's zero. Moves must be in program
  // order.
  void cut(const Curve& curve, const Point& zero, const WireMove& move);
  // Must be called at the end: moves are processed in batches of some thousands.
  void finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
