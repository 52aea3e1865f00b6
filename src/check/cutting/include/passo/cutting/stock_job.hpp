// What is needed to cut a piece of stock by a program: the block, the shapes of the tools and the clamps, as somebody
// wishes them, and from a first look at the program's feeds.
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
#include "passo/machine_file/tool_shapes_file.hpp"
#include "passo/stock/height_field.hpp"
#include "passo/stock/stock_cutter.hpp"

namespace passo {

// A range of X, Y or Z in mm; nothing: as the feeds need it.
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
  ToolShapes shapes;
  std::optional<ToolShape> any_tool;
  std::vector<StockBlock> clamps;
  std::optional<double> cell;  // mm
};

// A program that is cut, with what it was read with. `machine`: see SimulatedPath.
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

// What the first look at a program finds.
struct FeedLook {
  FeedReach feeds;                              // of the tools' edges in X and Y, of the tip in Z
  std::map<std::int32_t, std::uint32_t> tools;  // that feed, with the line of their first feed
  double zero = 0;                              // Z of the work's zero, machine coordinates
  std::uint64_t moves = 0;

  // The numbers of the tools, in order.
  std::vector<std::int32_t> numbers() const;
  // Where each tool stands among them, and in what shapes_of() returns.
  std::map<std::int32_t, std::size_t> places() const;
};
// `after_move`, if any, is called after each move, and may show the findings.
FeedLook survey_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings,
                      const std::function<void()>& after_move = {});

// A tool of which nobody says what shape it has, with the line of its first feed.
struct ShapelessTool {
  std::int32_t number = 0;
  std::uint32_t line = 0;
};
// In the order of `look.tools`. The error: all tools without a shape.
Result<std::vector<ToolShape>, std::vector<ShapelessTool>> shapes_of(const StockJob& job, const StockWishes& wishes,
                                                                     const FeedLook& look);

// Why there is no such stock. Empty message: the program has no feed, and the wishes do not name the whole block.
using StockRefusal = FieldRefusal;
// The block that is wished for, and otherwise what the feeds need: the top at 0 where they go below.
Result<HeightField, StockRefusal> stock_field(const StockWishes& wishes, const FeedLook& look);

// What else happens in cut_stock(). Empty functions: nothing.
struct CutHooks {
  StockCutter::Watcher cut;  // gets each cut, in order
  // Cuts a feed, as in pieces. Empty: the feed is cut in one.
  std::function<void(StockCutter& cutter, const TipMove& move, const StockMove& kind)> feed = {};
  std::function<void(double share)> progress = {};  // is told now and then
};
// Cuts the field by the program. `look` is of the same program, and `tools` its shapes. `threads`: 1 to 64.
void cut_stock(const StockJob& job, const StockWishes& wishes, const FeedLook& look,
               const std::vector<ToolShape>& tools, unsigned threads, HeightField& field, const CutHooks& hooks);

}  // namespace passo
