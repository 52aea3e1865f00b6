#include "passo/cutting/stock_job.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

// Nothing: the program has no feed, and the wishes do not name the whole block.
std::optional<StockBlock> block_of(const WishedBlock& wished, const FeedReach& feeds) {
  const auto all = {wished.x.low, wished.x.high, wished.y.low, wished.y.high, wished.z.low, wished.z.high};
  const bool is_whole = std::ranges::all_of(all, [](const auto& end) { return end.has_value(); });
  if (!is_whole && !feeds.any()) return {};
  const double top = feeds.low.z < 0 ? 0 : feeds.high.z;
  StockBlock block;
  block.low = {wished.x.low.value_or(feeds.low.x), wished.y.low.value_or(feeds.low.y),
               wished.z.low.value_or(feeds.low.z - usual_rest)};
  block.high = {wished.x.high.value_or(feeds.high.x), wished.y.high.value_or(feeds.high.y),
                wished.z.high.value_or(top)};
  return block;
}

// The options with the tool well above the stock before the first move.
InterpreterOptions options_above(const StockJob& job, const FeedLook& look, const HeightField& field) {
  InterpreterOptions options = job.options;
  options.start[Axis::z] += look.zero + field.top() + start_height;
  return options;
}

// Gives the moves of the program to the cutter.
void cut_moves(const StockJob& job, const FeedLook& look, const HeightField& field, StockCutter& cutter,
               const CutHooks& hooks) {
  const std::map<std::int32_t, std::size_t> places = look.places();
  Diagnostics findings;  // the first look has them
  SimulatedPath path(job.program.again(), options_above(job, look, field), job.machine, findings);
  TipMove move;
  for (std::uint64_t moves = 0; path.next(move); ++moves) {
    constexpr std::uint64_t moves_between_looks = 8192;
    if (hooks.progress && moves % moves_between_looks == 0) {
      hooks.progress(static_cast<double>(moves) / static_cast<double>(look.moves));
    }
    // A tool that only goes to where another one is taken up need not have a shape.
    const auto place = places.find(move.tool);
    if (place == places.end() || move.segment->takes_up_backlash) continue;
    const StockMove kind{.line = move.segment->source.line,
                         .tool = place->second,
                         .rapid = move.segment->rapid,
                         .time = move.time,
                         .rounding = job.machine != nullptr ? move.segment->tolerance : Mm(0)};
    if (hooks.rapid && kind.rapid) hooks.rapid(move, kind);
    if (hooks.feed && !kind.rapid) {
      hooks.feed(cutter, move, kind);
    } else {
      cutter.cut(move.segment->curve, Vector3::of(move.zero), kind);
    }
  }
  cutter.finish();
}

}  // namespace

std::vector<std::int32_t> FeedLook::numbers() const {
  std::vector<std::int32_t> numbers;
  for (const auto& [number, line] : tools) numbers.push_back(number);
  return numbers;
}

std::map<std::int32_t, std::size_t> FeedLook::places() const {
  std::map<std::int32_t, std::size_t> places;
  for (const auto& [number, line] : tools) places.emplace(number, places.size());
  return places;
}

FeedLook survey_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings,
                      const std::function<void()>& after_move) {
  FeedLook pass;
  SimulatedPath path(job.program.again(), job.options, job.machine, findings);
  TipMove move;
  while (path.next(move)) {
    if (pass.moves++ == 0) pass.zero = move.zero[Axis::z];
    if (after_move) after_move();
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
  return pass;
}

Result<std::vector<ToolShape>, std::vector<ShapelessTool>> shapes_of(const StockJob& job, const StockWishes& wishes,
                                                                     const FeedLook& look) {
  std::vector<ToolShape> tools;
  std::vector<ShapelessTool> shapeless;
  for (const auto& [number, line] : look.tools) {
    if (const auto shape = shape_of(wishes, job.options, number)) {
      tools.push_back(*shape);
    } else {
      shapeless.push_back({.number = number, .line = line});
    }
  }
  if (!shapeless.empty()) return Failure{std::move(shapeless)};
  return tools;
}

Result<HeightField, StockRefusal> stock_field(const StockWishes& wishes, const FeedLook& look) {
  const std::optional<StockBlock> block = block_of(wishes.block, look.feeds);
  if (!block) return Failure{StockRefusal{}};
  return HeightField::create(*block, wishes.cell ? Mm(*wishes.cell) : HeightField::usual_cell(*block));
}

void cut_stock(const StockJob& job, const StockWishes& wishes, const FeedLook& look,
               const std::vector<ToolShape>& tools, unsigned threads, HeightField& field, const CutHooks& hooks) {
  StockCutter cutter(field, {.tools = tools, .clamps = wishes.clamps, .threads = threads}, hooks.cut);
  cut_moves(job, look, field, cutter, hooks);
}

void cut_walls(const StockJob& job, const FeedLook& look, const std::vector<ToolShape>& tools, unsigned threads,
               const HeightField& field, WallHeights& walls) {
  if (!walls.any()) return;
  StockCutter cutter(field, walls, {.tools = tools, .clamps = {}, .threads = threads});
  cut_moves(job, look, field, cutter, {});
}

}  // namespace passo
