// The input for cutting a piece of stock by a program: the block, the shapes of the tools and the clamps, from the
// user's settings and from a first pass over the program's feed moves.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/cutting/simulated_path.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/tool_shape.hpp"
#include "passo/stock/height_field.hpp"
#include "passo/stock/stock_cutter.hpp"

namespace passo {

// A range of X, Y or Z in mm; nothing: as the feed moves require.
struct WishedRange {
  std::optional<double> low;
  std::optional<double> high;
};
struct WishedBlock {
  WishedRange x;
  WishedRange y;
  WishedRange z;
};
struct StockWishes {
  WishedBlock block;
  std::map<std::int32_t, ToolShape> shapes;  // by tool number
  std::optional<ToolShape> any_tool;
  std::vector<StockBlock> clamps;
  std::optional<double> cell;  // mm
};

// A program to be cut, with the options for reading it. `machine`: see SimulatedPath.
struct StockJob {
  ProgramReader program;
  InterpreterOptions options;
  const MachineDescription* machine = nullptr;
};

struct FeedReach {
  Vector3 low{1e9, 1e9, 1e9};
  Vector3 high{-1e9, -1e9, -1e9};
  bool any() const { return low.x <= high.x; }
};

// The result of the first pass over a program.
struct FeedLook {
  FeedReach feeds;                              // range of the feed moves: of the tools' edges in X and Y, of the tip
                                                // in Z
  std::map<std::int32_t, std::uint32_t> tools;  // the tools that cut, with the line of their first feed move
  double zero = 0;                              // Z of the work zero, machine coordinates
  std::uint64_t moves = 0;

  // Returns the tool numbers, in order.
  std::vector<std::int32_t> numbers() const;
  // Returns the index of each tool among them, and in the result of shapes_of().
  std::map<std::int32_t, std::size_t> places() const;
};
// Makes the first pass. `after_move`, if set, is called after each move, e.g. to show the findings.
FeedLook survey_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings,
                      const std::function<void()>& after_move = {});

// A tool without a given shape, and the line of its first feed move.
struct ShapelessTool {
  std::int32_t number = 0;
  std::uint32_t line = 0;
};
// Returns the shapes in the order of `look.tools`. The error: all tools without a shape.
Result<std::vector<ToolShape>, std::vector<ShapelessTool>> shapes_of(const StockJob& job, const StockWishes& wishes,
                                                                     const FeedLook& look);

// The reason why the stock cannot be created. Empty message: the program has no feed move, and the settings do not
// define the whole block.
using StockRefusal = FieldRefusal;
// Creates the requested block; missing ranges are as the feed moves require: the top is at 0 if they go below 0.
Result<HeightField, StockRefusal> stock_field(const StockWishes& wishes, const FeedLook& look);

// Optional callbacks of cut_stock().
struct CutHooks {
  StockCutter::Watcher cut;  // receives each cut, in order
  // Cuts a feed move, e.g. in pieces. Empty: the move is cut as a whole.
  std::function<void(StockCutter& cutter, const TipMove& move, const StockMove& kind)> feed = {};
  std::function<void(double share)> progress = {};  // called from time to time
  // Sees each rapid before it is cut.
  std::function<void(const TipMove& move, const StockMove& kind)> rapid = {};
};
// Cuts the field by the program. `look` and `tools` must be those of this program. `threads`: 1 to 64.
void cut_stock(const StockJob& job, const StockWishes& wishes, const FeedLook& look,
               const std::vector<ToolShape>& tools, unsigned threads, HeightField& field, const CutHooks& hooks);
// Finds the heights at the walls of a field that cut_stock() has cut by the same program.
void cut_walls(const StockJob& job, const FeedLook& look, const std::vector<ToolShape>& tools, unsigned threads,
               const HeightField& field, WallHeights& walls);

}  // namespace passo
