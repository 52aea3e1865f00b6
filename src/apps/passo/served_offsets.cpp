#include "served_offsets.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/interpreter/tool_table_file.hpp"
#include "passo/report/output_file.hpp"

namespace passo {
namespace {

void replace(const std::string& path, const std::string& text) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  Status<OutputError> done = file ? Status<OutputError>(Unit{}) : Status<OutputError>(Failure{file.error()});
  if (file) {
    file->write(text);
    done = file->commit();
  }
  if (!done) note(done.error().message);
}

}  // namespace

ServedOffsets::ServedOffsets(const std::string& folder)
    : parameter_file_((std::filesystem::path(folder) / "work.var").string()),
      tool_file_((std::filesystem::path(folder) / "tool.tbl").string()) {}

bool ServedOffsets::read() {
  Diagnostics diagnostics;
  std::error_code none;
  if (std::filesystem::exists(parameter_file_, none)) {
    static_cast<void>(read_parameter_file(parameter_file_, parameters_, diagnostics));
  }
  if (std::filesystem::exists(tool_file_, none)) {
    tools_.name = tool_file_;
    static_cast<void>(read_tool_table(tool_file_, LengthUnits::mm, tools_, diagnostics));
    std::ifstream file(tool_file_, std::ios::binary);
    tool_lines_.assign(std::istreambuf_iterator<char>(file), {});
  }
  show(diagnostics);
  return !diagnostics.any_error();
}

void ServedOffsets::keep(const SavedParameters& parameters, const ToolTable& tools) {
  if (parameters != parameters_) replace(parameter_file_, parameter_file_text(parameters));
  parameters_ = parameters;
  if (tools == tools_) return;
  for (const auto& [number, tool] : tools.all()) {
    if (tools_.find(number) != nullptr) continue;
    if (!tool_lines_.empty() && tool_lines_.back() != '\n') tool_lines_ += '\n';
    tool_lines_ += fmt::format("T{} P{}\n", number, tool.pocket);
  }
  tools_ = tools;
  tool_lines_ = tool_table_text(tool_lines_, LengthUnits::mm, tools_);
  replace(tool_file_, tool_lines_);
}

}  // namespace passo
