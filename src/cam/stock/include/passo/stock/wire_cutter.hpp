// WireCutter: what the moves of a program melt out of a block of foam with a hot wire.
//
// The wire is straight, from the left tower (X Y) to the right one (U V, or X Y too). In each slice of the block it
// goes along a line of its own, and melts half of its kerf on both sides. The kerf follows the speed in that slice.
// What is melted is the union of these ways: exact along lines; arcs become chords within a tenth of a cell.
//
// Slices are shared out to threads, and none needs another one. Cells take the least of distances. So the result is the
// same, bit for bit, for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "passo/geometry/curve.hpp"
#include "passo/stock/foam_block.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct WireMove {
  std::uint32_t line = 0;  // of the program
  bool rapid = false;
  Seconds time{0};  // how long it takes; 0: not known, and the wire melts as little as it can
};

// What a move did. Volume in mm³, lengths in mm.
struct WireCut {
  WireMove move;
  double volume = 0;
  double least_kerf = 0;  // in the block's slices
  double most_kerf = 0;
  Vector3 place{};  // one that it melted, if it melted any
};

struct WireCutterOptions {
  bool has_four_axes = false;  // the right end goes by U V
  double span = 0;             // Z of the right tower, mm; used with four axes
  // The kerf, mm, of a move whose wire goes at this speed, mm/s, for so long, s. Infinite speed: not known.
  std::function<double(double speed, double time)> kerf = {};
  unsigned threads = 1;
};

class WireCutter {
 public:
  using Watcher = std::function<void(const WireCut&)>;

  // The foam outlives the cutter. `watcher` may be empty.
  WireCutter(FoamBlock& foam, const WireCutterOptions& options, Watcher watcher);
  ~WireCutter();

  // A curve in machine coordinates; `zero`: where the program's zero lies. Moves come in the order of the program.
  void cut(const Curve& curve, const Point& zero, const WireMove& move);
  // Call it at the end: moves are cut some thousands at a time.
  void finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
