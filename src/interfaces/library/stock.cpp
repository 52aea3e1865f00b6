#include <cmath>
#include <numbers>
#include <utility>

#include "inner_types.hpp"
#include "program_content.hpp"
#include <fmt/format.h>

#include "passo/cutting/simulation.hpp"
#include "passo/cutting/stock_job.hpp"
#include "passo/library/picture.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo::v1 {
namespace {

passo::WishedRange wished(const std::optional<AxisRange>& range) {
  if (!range) return {};
  return {.low = range->low, .high = range->high};
}

passo::ToolShape shape_of(const MillingTool& tool) {
  const passo::Mm diameter(tool.diameter_mm);
  switch (tool.kind) {
    case MillingTool::Kind::ball: return {.cutter = passo::Cutter::ball(diameter)};
    case MillingTool::Kind::vee:
      return {.cutter = passo::Cutter::vee(diameter, passo::Radians{tool.included_angle_deg * std::numbers::pi / 180},
                                           passo::Mm(tool.tip_diameter_mm))};
    case MillingTool::Kind::flat: break;
  }
  return {.cutter = passo::Cutter::flat_end(diameter)};
}

std::vector<Finding> option_errors_of(const StockOptions& options) {
  std::vector<Finding> errors;
  const auto add = [&errors](std::string message, std::string expected) {
    errors.push_back(error_of("stock.option", "", 0, std::move(message), std::move(expected)));
  };
  constexpr double most_mm = 1e5;
  for (const auto& range : {options.x_mm, options.y_mm, options.z_mm}) {
    if (!range || (range->low >= -most_mm && range->low < range->high && range->high <= most_mm)) continue;
    add(fmt::format("the range {} to {} mm", range->low, range->high), "an ascending range within ±100,000 mm");
  }
  constexpr unsigned most_threads = 64;
  if (options.threads < 1 || options.threads > most_threads) {
    add(fmt::format("{} threads", options.threads), fmt::format("1 to {}", most_threads));
  }
  if (options.cell_mm != 0 && !(options.cell_mm >= 1e-3 && options.cell_mm <= 1e3)) {
    add(fmt::format("cells of {} mm", options.cell_mm), "0.001 to 1000 mm; 0: about a million cells");
  }
  if (!options.tool) return errors;
  const MillingTool& tool = *options.tool;
  if (!(tool.diameter_mm >= 0.01 && tool.diameter_mm <= 500)) {
    add(fmt::format("a tool of {} mm", tool.diameter_mm), "a diameter of 0.01 to 500 mm");
  } else if (tool.kind == MillingTool::Kind::vee &&
             !(tool.included_angle_deg >= 1 && tool.included_angle_deg <= 179 && tool.tip_diameter_mm >= 0 &&
               tool.tip_diameter_mm < tool.diameter_mm)) {
    add(fmt::format("an angle of {} degrees and a tip of {} mm", tool.included_angle_deg, tool.tip_diameter_mm),
        "1 to 179 degrees, and a tip that is smaller than the diameter");
  } else if (const std::string flaw = passo::flaw_of(shape_of(tool)); !flaw.empty()) {
    add("the tool has an impossible shape", flaw);
  }
  return errors;
}

std::vector<Finding> tool_errors_of(const Program& program, const std::vector<passo::ShapelessTool>& tools) {
  std::vector<Finding> errors;
  for (const passo::ShapelessTool& tool : tools) {
    errors.push_back(error_of("simulate.no-tool", program.name(), tool.line,
                              fmt::format("no shape given for tool T{}", tool.number),
                              "StockOptions::tool or tools_file"));
  }
  return errors;
}

Stock stock_of(const passo::HeightField& field, double volume_before) {
  Stock stock{.cell_mm = field.cell(),
              .left_mm = field.block().low.x,
              .front_mm = field.block().low.y,
              .top_mm = field.top(),
              .bottom_mm = field.bottom(),
              .columns = field.columns(),
              .rows = field.rows(),
              .below_top_mm = {},
              .removed_mm3 = volume_before - field.volume()};
  stock.below_top_mm.reserve(stock.columns * stock.rows);
  for (std::size_t row = 0; row < stock.rows; ++row) {
    const float* heights = field.below_top(row);
    stock.below_top_mm.insert(stock.below_top_mm.end(), heights, heights + stock.columns);
  }
  return stock;
}

}  // namespace

Outcome<Stock> cut_stock(const Program& program, const StockOptions& options) {
  if (std::vector<Finding> errors = option_errors_of(options); !errors.empty())
    return Outcome<Stock>(std::move(errors));
  passo::Diagnostics diagnostics;
  passo::StockWishes wishes{.block = {wished(options.x_mm), wished(options.y_mm), wished(options.z_mm)},
                            .shapes = {},
                            .any_tool = {},
                            .clamps = {},
                            .cell = {}};
  if (options.cell_mm > 0) wishes.cell = options.cell_mm;
  if (options.tool) wishes.any_tool = shape_of(*options.tool);
  if (!options.tools_file.empty()) {
    if (const auto library = passo::ToolLibrary::read(options.tools_file, diagnostics))
      wishes.shapes = library->shapes();
  }
  passo::InterpreterOptions read = interpreter_options_of(options.read, diagnostics);
  if (diagnostics.any_error()) return Outcome<Stock>(findings_of(diagnostics));
  const passo::StockJob job{program.content().reader.again(), std::move(read), nullptr};
  const passo::FeedLook look = passo::survey_feeds(job, wishes, diagnostics);
  if (diagnostics.any_error()) return Outcome<Stock>(findings_of(diagnostics));
  const auto tools = passo::shapes_of(job, wishes, look);
  if (!tools) return Outcome<Stock>(tool_errors_of(program, tools.error()));
  auto field = passo::stock_field(wishes, look);
  if (!field) {
    const std::string& words = field.error().message;
    return Outcome<Stock>({error_of("simulate.stock", program.name(), 0,
                                    words.empty() ? "the program has no feed moves, so the stock has no size" : words,
                                    "ranges of X, Y and Z")});
  }
  const double volume_before = field->volume();
  passo::CutSummary summary(*tools);
  passo::cut_stock(job, wishes, look, *tools, options.threads, *field,
                   {.cut = [&](const passo::MoveCut& cut) { summary.add(cut); }, .feed = {}, .progress = {}});
  Stock stock = stock_of(*field, volume_before);
  passo::add_findings(passo::Simulation{.program = program.name(),
                                        .target = {},
                                        .field = std::move(*field),
                                        .volume_before = volume_before,
                                        .numbers = look.numbers(),
                                        .tools = *tools,
                                        .summary = std::move(summary)},
                      diagnostics);
  return {std::move(stock), findings_of(diagnostics)};
}

}  // namespace passo::v1
