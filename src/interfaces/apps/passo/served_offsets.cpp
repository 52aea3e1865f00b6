#include "served_offsets.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "program_input.hpp"

#include "passo/interpreter/tool_table_file.hpp"
#include "passo/report/output_file.hpp"

namespace passo {
namespace {

// Returns why it cannot be; empty: it is.
std::string replace(const std::string& path, const std::string& text) {
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  Status<OutputError> done = file ? Status<OutputError>(Unit{}) : Status<OutputError>(Failure{file.error()});
  if (file) {
    file->write(text);
    done = file->commit();
  }
  return done ? std::string() : done.error().message;
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

std::string ServedOffsets::keep(const SavedParameters& parameters, const ToolTable& tools) {
  if (parameters != parameters_) {
    if (std::string why = replace(parameter_file_, parameter_file_text(parameters)); !why.empty()) return why;
    parameters_ = parameters;
  }
  if (tools == tools_) return {};
  std::string lines = tool_lines_;
  add_new_tools(lines, tools_, tools);
  lines = tool_table_text(lines, LengthUnits::mm, tools);
  if (std::string why = replace(tool_file_, lines); !why.empty()) return why;
  tools_ = tools;
  tool_lines_ = std::move(lines);
  return {};
}

}  // namespace passo
