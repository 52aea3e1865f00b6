#include "stock_setup.hpp"

#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/tooling/tool_library.hpp"

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
  const auto library = ToolLibrary::read(path, findings);
  show(findings);
  if (!library) return false;
  wishes.shapes.merge(library->shapes());
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
                  .message = fmt::format("no shape given for tool T{}", tool.number),
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
  fail(exit_bad_program,
       (words.empty() ? "the program has no feed moves, so the size of the stock is unknown; give it with --stock"
                      : words) +
           " [simulate.stock]");
  return std::nullopt;
}

}  // namespace passo
