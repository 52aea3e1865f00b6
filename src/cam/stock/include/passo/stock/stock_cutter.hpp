// StockCutter: what the moves of a program take off a piece of stock.
//
// Position in the pipeline: outside it. The cutter watches the path, and hands nothing back to it. Moves go in, in the
// order of the program. For each of them comes out how much it took off (MoveCut), and in the end the HeightField shows
// what is left.
//
// The tool's swept volume is exact along straight moves: for each cell the lowest height that the underside of the tool
// reaches there, in closed form (for round corners by an iteration to 0.3 um for each mm of the radius). Arcs, helices
// and curves become chords that stay within a tenth of a cell.
//
// The field is cut in tiles of 64 x 64 cells. A tile sees the moves in their order, and no tile needs another one. So
// tiles are shared out to threads, and the result is the same, bit for bit, for any number of threads. Memory: that of
// the field, and some MiB for the moves in hand.
//
// MoveCut::volume over MoveCut::time is the rate at which a move removes material. Times the material's specific
// cutting force (N/mm²) it is the power that the cut takes: what a load of the plant needs.
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
#include "passo/units/units.hpp"

namespace passo {

struct StockMove {
  std::uint32_t line = 0;  // of the program
  std::size_t tool = 0;    // which of the tools
  bool rapid = false;
  Seconds time{0};  // how long it takes
  // A rapid that a machine rounds into a feed goes through the stock by so much. On rapids the tool is thinner by that.
  Mm rounding{0};
};

// What a move did. Volumes in mm³, lengths in mm, areas in mm².
struct MoveCut {
  StockMove move;
  double way = 0;        // along the path
  double way_level = 0;  // the part of the way in X and Y
  double volume = 0;
  double area = 0;    // of the cells from which it took something, seen from above
  double depth = 0;   // the most that it took off anywhere
  Vector3 place{};    // where: the middle of the cell, and the height there before the cut
  double below = 0;   // how far below the stock's bottom the tip was, where it cut
  double holder = 0;  // how deep the holder was in the stock
  Vector3 holder_place{};
  double clamp = 0;  // how deep the tool or its holder was in a clamp
  Vector3 clamp_place{};
};

struct StockCutterOptions {
  std::vector<ToolShape> tools = {};
  std::vector<StockBlock> clamps = {};  // obstacles, solid from their top down
  unsigned threads = 1;                 // 1 to 64
};

class StockCutter {
 public:
  using Watcher = std::function<void(const MoveCut&)>;

  // `field` outlives the cutter. `watcher` gets every move, in the order of the program, a batch at a time.
  StockCutter(HeightField& field, const StockCutterOptions& options, Watcher watcher);
  ~StockCutter();
  StockCutter(const StockCutter&) = delete;
  StockCutter& operator=(const StockCutter&) = delete;

  // The tip goes along `curve`, whose places lie `zero` away from those of the stock: stock = curve - zero.
  void cut(const Curve& curve, const Vector3& zero, const StockMove& move);
  // Cuts what is left of the last batch. Call it at the end; only then the field is right.
  void finish();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
