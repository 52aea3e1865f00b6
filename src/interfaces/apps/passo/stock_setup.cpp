#include "stock_setup.hpp"

#include <algorithm>
#include <cmath>

#include "program_input.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// Where the tool stands before the first move, above the stock.
constexpr double start_height = 50;  // mm
// How much thicker the stock is than the deepest feed, where nobody says.
constexpr double usual_rest = 2;  // mm

// An option goes before the file of tools, and the file before the tool table of the machine.
std::optional<ToolShape> shape_of(const StockWishes& wishes, const InterpreterOptions& options, std::int32_t number) {
  if (const auto found = wishes.shapes.find(number); found != wishes.shapes.end()) return found->second;
  if (wishes.any_tool) return wishes.any_tool;
  const Tool* const tool = options.tools.find(number);
  if (tool == nullptr || tool->diameter == Mm(0)) return std::nullopt;
  return ToolShape{.cutter = Cutter::flat_end(Mm(std::abs(tool->diameter.value())))};
}

Result<StockBlock, std::string> block_of(const WishedBlock& wished, const FeedReach& feeds) {
  const auto all = {wished.x.low, wished.x.high, wished.y.low, wished.y.high, wished.z.low, wished.z.high};
  const bool is_whole = std::ranges::all_of(all, [](const auto& end) { return end.has_value(); });
  if (!is_whole && !feeds.any())
    return Failure{std::string("the program has no feed: say with --stock how large the stock is")};
  const double top = feeds.low.z < 0 ? 0 : feeds.high.z;
  StockBlock block;
  block.low = {wished.x.low.value_or(feeds.low.x), wished.y.low.value_or(feeds.low.y),
               wished.z.low.value_or(feeds.low.z - usual_rest)};
  block.high = {wished.x.high.value_or(feeds.high.x), wished.y.high.value_or(feeds.high.y),
                wished.z.high.value_or(top)};
  return block;
}

}  // namespace

Result<StockWishes, std::string> stock_wishes(const StockArguments& arguments) {
  StockWishes wishes;
  wishes.cell = arguments.cell;
  if (!arguments.block.empty()) {
    Result<WishedBlock, std::string> block = parse_block("--stock", arguments.block);
    if (!block) return Failure{block.error()};
    wishes.block = *block;
  }
  for (const std::string& text : arguments.clamps) {
    Result<StockBlock, std::string> clamp = parse_clamp(text);
    if (!clamp) return Failure{clamp.error()};
    wishes.clamps.push_back(*clamp);
  }
  for (const std::string& text : arguments.tools) {
    Result<WishedTool, std::string> tool = parse_tool(text);
    if (!tool) return Failure{tool.error()};
    if (tool->number) {
      wishes.shapes[*tool->number] = tool->shape;
    } else {
      wishes.any_tool = tool->shape;
    }
  }
  return wishes;
}

bool read_tool_table(const std::string& path, StockWishes& wishes) {
  if (path.empty()) return true;
  Diagnostics findings;
  const auto shapes = read_tool_shapes(path, findings);
  show(findings);
  if (!shapes) return false;
  wishes.shapes.insert(shapes->begin(), shapes->end());
  return true;
}

std::map<std::int32_t, std::size_t> FeedLook::places() const {
  std::map<std::int32_t, std::size_t> places;
  for (const auto& [number, line] : tools) places.emplace(number, places.size());
  return places;
}

FeedLook look_at_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings) {
  FeedLook pass;
  SimulatedPath path(job.program.again(), job.options, job.machine, findings);
  TipMove move;
  FindingsDisplay display(findings);
  while (path.next(move)) {
    if (pass.moves++ == 0) pass.zero = move.zero[Axis::z];
    display.update();
    if (move.segment->rapid) continue;
    pass.tools.try_emplace(move.tool, move.segment->source.line);
    const Box box = move.segment->curve.extents();
    const auto shape = shape_of(wishes, job.options, move.tool);
    const double radius = shape ? shape->cutter.radius.value() : 0;
    const Vector3 low = Vector3::of(box.low - move.zero) - Vector3{radius, radius, 0};
    const Vector3 high = Vector3::of(box.high - move.zero) + Vector3{radius, radius, 0};
    FeedReach& feeds = pass.feeds;
    feeds.low = {std::min(feeds.low.x, low.x), std::min(feeds.low.y, low.y), std::min(feeds.low.z, low.z)};
    feeds.high = {std::max(feeds.high.x, high.x), std::max(feeds.high.y, high.y), std::max(feeds.high.z, high.z)};
  }
  display.finish();
  return pass;
}

std::optional<std::vector<ToolShape>> shapes_of(const StockJob& job, const StockWishes& wishes, const FeedLook& pass) {
  std::vector<ToolShape> tools;
  Diagnostics findings;
  for (const auto& [number, line] : pass.tools) {
    const auto shape = shape_of(wishes, job.options, number);
    tools.push_back(shape.value_or(ToolShape{}));
    if (shape) continue;
    findings.add({.severity = Severity::error,
                  .code = "simulate.no-tool",
                  .file = job.program.name(),
                  .place = {.line = line, .column = 0, .length = 1},
                  .message = fmt::format("nobody says what shape T{} has", number),
                  .expected = fmt::format("--tool {}=flat:6, or a --tool-table", number),
                  .text = {}});
  }
  show(findings);
  if (findings.any_error()) return std::nullopt;
  return tools;
}

Result<HeightField, std::string> stock_field(const StockWishes& wishes, const FeedLook& look) {
  const Result<StockBlock, std::string> block = block_of(wishes.block, look.feeds);
  if (!block) return Failure{block.error() + " [simulate.stock]"};
  const Mm cell = wishes.cell ? Mm(*wishes.cell) : HeightField::usual_cell(*block);
  Result<HeightField, FieldRefusal> field = HeightField::create(*block, cell);
  if (!field) return Failure{field.error().message + " [simulate.stock]"};
  return std::move(*field);
}

InterpreterOptions options_above(const StockJob& job, const FeedLook& look, const HeightField& field) {
  InterpreterOptions options = job.options;
  options.start[Axis::z] += look.zero + field.top() + start_height;
  return options;
}

}  // namespace passo
