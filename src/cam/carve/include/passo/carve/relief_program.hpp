// write_relief: generates the program that carves a relief: roughing, finishing and rest finishing, each with its own
// cutter.
//
// The program is in mm (G21), with Z 0 at the top of the stock. It is passed to the sink in pieces during generation:
// memory grows with the surface, not with the program. Each feed move is gouge-free over its whole length
// (passo/carve/dropped_cutter.hpp), and at most `tolerance` higher than necessary. The cutters travel beyond the
// surface by `overrun`, so that its edges are cut fully. There the surface continues, or the only limit is the floor,
// its lowest height (`beside`).
//
// Equal surfaces and options give identical output, for any number of threads.
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

// The finishing strategy. Rows are parallel to X. A spiral follows the sides of a rectangle inwards. Contours are at
// constant heights where the toolpath would be steeper than `steep`, with rows on the remaining area.
enum class FinishStrategy : std::uint8_t { rows, columns, both, spiral, contours };
// The roughing strategy: rows, or offsets of the area that a level removes, from the inside outwards.
enum class RoughStrategy : std::uint8_t { rows, offsets };

// The direction in which rows are cut: alternating, or always the one in which a clockwise spindle climb mills, or
// mills conventionally.
enum class RowDirection : std::uint8_t { there_and_back, climb, conventional };

struct ReliefPoint {
  Mm x{};
  Mm y{};
};

struct ReliefTool {
  Cutter cutter = {};
  Mm step_over{0};  // stepover; 0: derived from `scallop`
  Mm feed{1000};    // mm/min
  Mm plunge{300};   // maximum downward speed of the tip, mm/min
  // Target removal rate, mm³/min: the feed is reduced, at most to a tenth, or increased, at most to `fastest`, to keep
  // it constant. 0: constant feed.
  double removal = 0;
  Mm fastest{0};  // maximum feed, mm/min; 0: as `feed`
};

struct ReliefRoughing {
  ReliefTool tool = {};
  RoughStrategy way = RoughStrategy::rows;
  Mm step_down{2};
  Mm stock{0.3};  // stock to leave, in all directions
};

struct ReliefRest {
  ReliefTool tool = {};
  Mm least{0.02};  // maximum material that the finishing cutter may leave without rest finishing
};

// The finishing rows.
struct ReliefRows {
  Radians steep{0.785398};  // slope above which contours take their place, if there are contours: 45 degrees
  RowDirection direction = RowDirection::there_and_back;
  Radians angle{0};  // from X, counterclockwise; not for columns
  // Adds rows on slopes, so that no scallop is higher than the scallop height. For cutters with a round tip or corner;
  // not for rows at an angle.
  bool has_even_scallops = false;
  bool has_pencil = false;  // after all rows, the last cutter also cuts along inner edges
};

// The part of the surface that is cut. Not available for spirals.
struct ReliefArea {
  // Only where a cutter touches material of the model above the floor, and one stepover around it.
  bool only_on_model = false;
  // The cutter's axis stays within these closed curves, in program coordinates; a curve within a curve is a hole.
  // Empty: no bound.
  std::vector<std::vector<ReliefPoint>> within = {};

  bool is_all() const { return !only_on_model && within.empty(); }
};

// The height and position of start, tool changes and end, and the spindle.
struct ReliefChange {
  Mm height{20};  // Z of the first and the last rapid, and of tool changes; at least the clearance height
  ReliefPoint park = {};
  std::optional<std::uint32_t> spindle = {};  // rpm; empty: no spindle commands
  double spindle_seconds = 2;                 // dwell after M3
  std::string_view coolant = {};              // M7 (mist) or M8 (flood); empty: off
};

struct ReliefProgramOptions {
  std::string name = {};                // program name, for the first comment
  std::vector<std::string> words = {};  // additional comments
  ReliefTool finish = {};
  FinishStrategy way = FinishStrategy::rows;
  bool arcs = true;  // use arcs where they save lines
  ReliefRows rows = {};
  std::optional<ReliefRoughing> roughing = {};
  std::optional<ReliefRest> rest = {};
  Mm scallop{0.02};      // scallop height between two rows on a flat area, if no stepover is given
  Mm tolerance{0.01};    // tolerance of lines, only upwards
  Mm clearance{5};       // clearance height
  bool ramps = true;     // enter the stock along a ramp; otherwise straight down
  Radians ramp{0.0873};  // ramp angle
  Mm x0{0};              // position of node (0, 0)
  Mm y0{0};
  // Empty: the finishing cutter's radius; for the roughing cutter at least its own radius.
  std::optional<Mm> overrun = {};
  BesideGrid beside = BesideGrid::goes_on;
  ReliefArea area = {};
  unsigned threads = 1;  // at least 1
  ReliefChange change = {};
};

// The statistics of one cutter's part of the program.
struct ReliefPart {
  std::string what = {};  // "roughing"
  std::string tool = {};  // description of the cutter
  Mm step{};              // stepover; 0 for a pencil pass
  std::uint64_t moves = 0;
  std::uint64_t arcs = 0;  // number of arcs among the moves
  Mm cut{};                // cutting distance
  Mm rapid{};
  double removal = 0;  // maximum removal rate, mm³/min, if it is controlled
  double minutes = 0;  // cutting time at the programmed feeds, without rapids and acceleration
};

// The surface that the cutters leave, at the nodes of the grid, mm.
struct CarvedSurface {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> heights = {};
};

struct ReliefReport {
  std::vector<ReliefPart> parts = {};
  CarvedSurface carved = {};  // the carved surface, if requested
};

using ReliefSink = std::function<void(std::string_view)>;
using ReliefProgress = std::function<void(double fraction)>;

// `wants_carved`: the report includes the carved surface with its scallops. This takes twice the memory of the surface.
ReliefReport write_relief(const HeightGrid& surface, const ReliefProgramOptions& options, const ReliefSink& sink,
                          const ReliefProgress& progress, bool wants_carved);

// Returns a shaded view of a carved surface, lit from the upper left, as a PNG of at most `most_side` pixels on each
// side. Empty on failure.
std::string draw_carved(const CarvedSurface& carved, Mm pitch_x, Mm pitch_y, std::size_t most_side = 900);

}  // namespace passo
