// StockCutter: simulates how the moves of a program remove material from a piece of stock.
//
// Position in the pipeline: outside. The cutter observes the path, and returns nothing to it. Moves are added in
// program order. For each of them the watcher receives the removed material (MoveCut); at the end the HeightField is
// the remaining stock.
//
// The tool's swept volume is exact along straight moves: for each cell the lowest height of the tool's underside there,
// in closed form (for round corners by an iteration to 0.3 um per mm of the radius). Arcs, helices and curves become
// chords that deviate by at most a tenth of a cell.
//
// The field is cut in tiles of 64 x 64 cells. Each tile processes the moves in order, independently of other tiles.
// Tiles are distributed to threads, and the result is the same, bit for bit, for any number of threads. Memory: that of
// the field, and some MiB for the moves being processed.
//
// MoveCut::volume over MoveCut::time is the material removal rate of a move. Multiplied by the material's specific
// cutting force (N/mm²) it is the cutting power, for the load of a simulated machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "passo/geometry/curve.hpp"
#include "passo/geometry/tool_shape.hpp"
#include "passo/stock/height_field.hpp"
#include "passo/stock/wall_heights.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct StockMove {
  std::uint32_t line = 0;  // line of the program
  std::size_t tool = 0;    // index of the tool
  bool rapid = false;
  Seconds time{0};  // duration
  // The maximum corner deviation of a rapid that the machine blends into a feed move. On rapids the tool is thinner by
  // this amount.
  Mm rounding{0};
};

// The effect of a move. Volumes in mm³, lengths in mm, areas in mm².
struct MoveCut {
  StockMove move;
  double way = 0;        // length along the path
  double way_level = 0;  // length of the path in X and Y
  double volume = 0;
  double area = 0;    // area of the cells in which it removed material, seen from above
  double depth = 0;   // maximum depth of cut
  Vector3 place{};    // position of the maximum: the centre of the cell, at the height before the cut
  double below = 0;   // depth of the tip below the stock's bottom, where it cut
  double holder = 0;  // depth of the holder in the stock
  Vector3 holder_place{};
  double clamp = 0;  // depth of the tool or its holder in a clamp
  Vector3 clamp_place{};
};

struct StockCutterOptions {
  std::vector<ToolShape> tools = {};
  std::vector<StockBlock> clamps = {};  // obstacles, solid from their top downwards
  unsigned threads = 1;                 // 1 to 64
};

class StockCutter {
 public:
  using Watcher = std::function<void(const MoveCut&)>;

  // `field` must outlive the cutter. `watcher` receives every move, in program order, in batches.
  StockCutter(HeightField& field, const StockCutterOptions& options, Watcher watcher);
  // Cuts `walls` instead of the field, from the height of the uncut stock. `field`: the stock after the same moves, to
  // which the walls belong. Clamps and holders are ignored. Both must outlive the cutter.
  StockCutter(const HeightField& field, WallHeights& walls, const StockCutterOptions& options);
  ~StockCutter();
  StockCutter(const StockCutter&) = delete;
  StockCutter& operator=(const StockCutter&) = delete;

  // The cells in which a clamp is checked: at most as wide as those of the stock, and usually at most 0.5 mm, so that
  // no tool passes between their centres.
  static Mm clamp_cell(const StockBlock& clamp, const HeightField& field);

  // Moves the tip along `curve`. `zero`: the offset of the curve's coordinates: stock = curve - zero.
  void cut(const Curve& curve, const Vector3& zero, const StockMove& move);
  // Cuts the last batch. Must be called at the end; the field is complete only then.
  void finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
