#include "stock_setup.hpp"

#include "program_input.hpp"
#include <fmt/format.h>

namespace passo {

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

bool add_tool_shapes(const std::string& path, StockWishes& wishes) {
  if (path.empty()) return true;
  Diagnostics findings;
  const auto shapes = read_tool_shapes(path, findings);
  show(findings);
  if (!shapes) return false;
  wishes.shapes.insert(shapes->begin(), shapes->end());
  return true;
}

FeedLook shown_feeds(const StockJob& job, const StockWishes& wishes, Diagnostics& findings) {
  FindingsDisplay display(findings);
  FeedLook look = survey_feeds(job, wishes, findings, [&display] { display.update(); });
  display.finish();
  return look;
}

std::optional<std::vector<ToolShape>> shapes_or_message(const StockJob& job, const StockWishes& wishes,
                                                        const FeedLook& look) {
  auto shapes = shapes_of(job, wishes, look);
  if (shapes) return std::move(*shapes);
  Diagnostics findings;
  for (const ShapelessTool& tool : shapes.error()) {
    findings.add({.severity = Severity::error,
                  .code = "simulate.no-tool",
                  .file = job.program.name(),
                  .place = {.line = tool.line, .column = 0, .length = 1},
                  .message = fmt::format("nobody says what shape T{} has", tool.number),
                  .expected = fmt::format("--tool {}=flat:6, or a --tool-table", tool.number),
                  .text = {}});
  }
  show(findings);
  return std::nullopt;
}

std::optional<HeightField> field_or_message(const StockWishes& wishes, const FeedLook& look) {
  auto field = stock_field(wishes, look);
  if (field) return std::move(*field);
  const std::string& words = field.error().message;
  fail(exit_bad_program, (words.empty() ? "the program has no feed: say with --stock how large the stock is" : words) +
                             " [simulate.stock]");
  return std::nullopt;
}

}  // namespace passo
