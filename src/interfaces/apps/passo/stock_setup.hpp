// What a command needs to cut a piece of stock by a program: the block, the shapes of the tools, and the clamps, from
// the command line, from files, and from a first look at the program's feeds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulated_path.hpp"
#include "stock_arguments.hpp"
#include "stock_options.hpp"

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct StockWishes {
  WishedBlock block;
  ToolShapes shapes;
  std::optional<ToolShape> any_tool;
  std::vector<StockBlock> clamps;
  std::optional<double> cell;
};

// The refusals of the command line come as messages. `tool_table` is not read.
Result<StockWishes, std::string> stock_wishes(const StockArguments& arguments);
// Reads a file of tools into the wishes. A tool of an option keeps its shape. False, with a message: the file is wrong.
bool read_tool_table(const std::string& path, StockWishes& wishes);

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

  // Where each tool stands in what shapes_of() returns.
  std::map<std::int32_t, std::size_t> places() const;
};
FeedLook look_at_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings);

// In the order of `look.tools`. Nothing, with a message: a tool has no shape.
std::optional<std::vector<ToolShape>> shapes_of(const StockJob& job, const StockWishes& wishes, const FeedLook& look);
// The block that is wished for, and otherwise what the feeds need: the top at 0 where they go below. The failure is a
// message.
Result<HeightField, std::string> stock_field(const StockWishes& wishes, const FeedLook& look);
// The options with the tool well above the stock before the first move.
InterpreterOptions options_above(const StockJob& job, const FeedLook& look, const HeightField& field);

}  // namespace passo
