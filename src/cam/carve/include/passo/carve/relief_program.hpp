// write_relief: the program that carves a relief: roughing, finishing, rest finishing, each with its own cutter.
//
// The program is in mm (G21), Z 0 at the top of the stock. It is handed on in pieces while it is made: memory grows
// with the surface, not with the program. Each feed move keeps clear of the surface, over its whole length
// (passo/carve/dropped_cutter.hpp), and is at most `tolerance` higher than it must be. The cutters go beyond the
// surface by `overrun`, so its edges are cut fully. There the surface goes on, or nothing bounds them but the floor,
// its lowest height (`beside`).
//
// The same surface and options make the same bytes, for any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/carve/dropped_cutter.hpp"
#include "passo/carve/height_grid.hpp"
#include "passo/geometry/cutter.hpp"

namespace passo {

// Rows are along X. A spiral goes inwards along the sides of a rectangle. Contours are at constant heights where the
// way is steeper than `steep`, and rows on the rest.
enum class FinishWay : std::uint8_t { rows, columns, both, spiral, contours };
// In rows, or by offsets of what a level takes off, from within outwards.
enum class RoughWay : std::uint8_t { rows, offsets };

struct ReliefTool {
  Cutter cutter = {};
  Mm step_over{0};  // 0: as `scallop` asks
  Mm feed{1000};    // a minute
  Mm plunge{300};   // the most that the tip goes down, a minute
  // What it takes off a minute, mm3: the feed falls to a tenth where it would be more, and rises to `fastest` where it
  // is less. 0: the feed knows nothing of it.
  double removal = 0;
  Mm fastest{0};  // a minute; 0: as `feed`
};

struct ReliefRoughing {
  ReliefTool tool = {};
  RoughWay way = RoughWay::rows;
  Mm step_down{2};
  Mm stock{0.3};  // what it leaves, each way
};

struct ReliefRest {
  ReliefTool tool = {};
  Mm least{0.02};  // what the finishing cutter may leave without rest finishing
};

struct ReliefProgramOptions {
  std::string name = {};                // of the program, for its first comment
  std::vector<std::string> words = {};  // more comments
  ReliefTool finish = {};
  FinishWay way = FinishWay::rows;
  Radians steep{0.785398};  // of contours: 45 degrees
  bool arcs = true;         // arcs where they save lines
  std::optional<ReliefRoughing> roughing = {};
  std::optional<ReliefRest> rest = {};
  Mm scallop{0.02};                           // the ridges between two rows on a flat, where no step is given
  Mm tolerance{0.01};                         // of lines, upwards
  Mm clearance{5};                            // height of rapids
  bool ramps = true;                          // enters the stock along a ramp; else straight down
  Radians ramp{0.0873};                       // its angle
  std::optional<std::uint32_t> spindle = {};  // turns a minute; empty: the program leaves the spindle alone
  Mm x0{0};                                   // of node (0, 0)
  Mm y0{0};
  // Empty: the radius of the finishing cutter; of the roughing cutter at least its own.
  std::optional<Mm> overrun = {};
  BesideGrid beside = BesideGrid::goes_on;
  unsigned threads = 1;  // 1 or more
};

// What was written for one cutter.
struct ReliefPart {
  std::string what = {};  // "roughing"
  std::string tool = {};  // its description
  Mm step{};              // between rows
  std::uint64_t moves = 0;
  std::uint64_t arcs = 0;  // of these
  Mm cut{};                // way in work
  Mm rapid{};
  double removal = 0;  // the most that was taken off a minute, mm3, where it is held
  double minutes = 0;  // of the work at the feeds given; rapids and ramps of speed not counted
};

// The surface that the cutters leave, at the grid's nodes, mm.
struct CarvedSurface {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> heights = {};
};

struct ReliefReport {
  std::vector<ReliefPart> parts = {};
  CarvedSurface carved = {};  // where it was wanted
};

using ReliefSink = std::function<void(std::string_view)>;
using ReliefProgress = std::function<void(double fraction)>;

// `wants_carved`: the report holds the carved surface, with the ridges between rows. Costs twice the surface's memory.
ReliefReport write_relief(const HeightGrid& surface, const ReliefProgramOptions& options, const ReliefSink& sink,
                          const ReliefProgress& progress, bool wants_carved);

// A shaded view of a carved surface, light from the upper left, as a PNG of at most `most_side` pixels a side. Empty:
// it could not be made.
std::string draw_carved(const CarvedSurface& carved, Mm pitch_x, Mm pitch_y, std::size_t most_side = 900);

}  // namespace passo
