// passo tools import and export: tool libraries of other programs.
#include <algorithm>
#include <array>
#include <filesystem>

#include "commands.hpp"
#include "program_input.hpp"
#include "tools_command.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/report/output_file.hpp"
#include "passo/tool_import/tool_import.hpp"
#include "passo/tooling/tool_library.hpp"
#include "passo/tooling/tool_library_text.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using ImportJson = nlohmann::ordered_json;

constexpr std::size_t largest_tool_file = std::size_t{32} << 20U;
constexpr std::size_t largest_tool_bit = std::size_t{1} << 20U;
constexpr std::size_t most_shown_notes = 20;

// A new file appears only when it is complete. An existing one is replaced only if that is asked for.
int write_new_file(const std::string& path, const std::string& text, bool force) {
  std::error_code none;
  if (!force && path != "-" && fs::exists(path, none)) {
    return fail(exit_bad_program, fmt::format("{} exists: give --force to replace it [tools.exists]", path));
  }
  Result<OutputFile, OutputError> file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(text);
  const Status<OutputError> written = file->commit();
  return written ? exit_done : fail(exit_failed, written.error().message);
}

// FreeCAD keeps libraries in Library/ and tool bits in Bit/. The name is a file name, without folders.
std::optional<std::string> read_tool_bit(const std::string& library, const std::string& name) {
  const fs::path folder = fs::path(library).parent_path();
  for (const fs::path& path : {folder / name, folder / ".." / "Bit" / name}) {
    std::error_code none;
    if (!fs::is_regular_file(path, none)) continue;
    Diagnostics findings;
    auto text = read_bytes(path.string(), {.area = "tool-import", .expected = "a tool bit", .most = largest_tool_bit},
                           findings);
    show(findings);
    return text;
  }
  return std::nullopt;
}

LengthUnits units_of(const std::string& name) {
  return name == "inch" ? LengthUnits::inch : LengthUnits::mm;
}

ToolImportOptions import_options(const ToolsImportArguments& arguments) {
  ToolImportOptions options;
  if (!arguments.units.empty()) options.units = units_of(arguments.units);
  constexpr std::array shapes = {CuttingShape::flat, CuttingShape::ball, CuttingShape::drill};
  const auto shape = std::ranges::find(shapes, arguments.shape, [](CuttingShape one) { return name_of(one); });
  if (shape != shapes.end()) options.shape = *shape;
  options.read_tool_bit = [&arguments](const std::string& name) { return read_tool_bit(arguments.file, name); };
  return options;
}

ImportJson notes_json(const std::vector<ToolImportNote>& notes) {
  ImportJson json = ImportJson::array();
  for (const ToolImportNote& note : notes) json.push_back({{"place", note.place}, {"text", note.text}});
  return json;
}

void print_json(const ToolsImportArguments& arguments, const ImportedTools& imported) {
  ImportJson json = {{"file", arguments.file}, {"format", name_of(imported.format)}, {"output", arguments.output}};
  json["tools"] = ImportJson::array();
  for (const CuttingTool& tool : imported.tools) {
    json["tools"].push_back({{"number", tool.number}, {"description", describe(tool)}});
  }
  json["changed"] = notes_json(imported.changed);
  json["left_out"] = notes_json(imported.left_out);
  json["unused"] = ImportJson::array();
  for (const UnusedField& field : imported.unused) {
    json["unused"].push_back({{"field", field.field}, {"count", field.count}, {"first", field.first}});
  }
  fmt::print("{}\n", json.dump(2, ' ', false, ImportJson::error_handler_t::replace));
}

void print_notes(std::string_view title, const std::vector<ToolImportNote>& notes) {
  if (notes.empty()) return;
  fmt::print("\n{}\n", title);
  for (std::size_t i = 0; i < std::min(notes.size(), most_shown_notes); ++i) {
    fmt::print("  {}: {}\n", notes[i].place, notes[i].text);
  }
  if (notes.size() > most_shown_notes) {
    fmt::print("  and {} more: --json lists all\n", notes.size() - most_shown_notes);
  }
}

void print_summary(const ToolsImportArguments& arguments, const ImportedTools& imported) {
  const std::size_t count = imported.tools.size();
  fmt::print("{}: {} {} of {} ({})\n", arguments.output, count, count == 1 ? "tool" : "tools", arguments.file,
             name_of(imported.format));
  print_notes("changed:", imported.changed);
  print_notes("left out:", imported.left_out);
  if (imported.unused.empty()) return;
  fmt::print("\nnot used:\n");
  for (const UnusedField& field : imported.unused) {
    fmt::print("  {} ({}, first {})\n", field.field, field.count, field.first);
  }
}

}  // namespace

int tools_import(const ToolsImportArguments& arguments) {
  Diagnostics findings;
  const auto bytes = read_bytes(
      arguments.file,
      {.area = "tool-import", .expected = "a tool library of another program", .most = largest_tool_file}, findings);
  const auto imported =
      bytes ? import_tools(*bytes, arguments.file, import_options(arguments), findings) : std::nullopt;
  show(findings);
  if (!imported) return exit_bad_program;
  if (imported->tools.empty()) {
    if (arguments.json) print_json(arguments, *imported);
    if (!arguments.json) print_notes("left out:", imported->left_out);
    flush_output();
    return fail(exit_bad_program, fmt::format("{}: no tool could be imported [tool-import.none]", arguments.file));
  }
  const std::string head = fmt::format("Imported from {} ({}) by passo tools import",
                                       fs::path(arguments.file).filename().string(), name_of(imported->format));
  const int code = write_new_file(arguments.output, tool_library_text(imported->tools, head), arguments.force);
  if (code != exit_done || arguments.output == "-") return code;
  if (arguments.json) {
    print_json(arguments, *imported);
  } else {
    print_summary(arguments, *imported);
  }
  return flush_output();
}

int tools_export(const ToolsExportArguments& arguments) {
  Diagnostics findings;
  const auto library = ToolLibrary::read(arguments.library, findings);
  show(findings);
  if (!library) return exit_bad_program;
  const bool is_table = arguments.format.empty() ? arguments.output.ends_with(".tbl") : arguments.format == "linuxcnc";
  if (arguments.format.empty() && !is_table && !arguments.output.ends_with(".json")) {
    return fail(exit_bad_program, "-o: expected a name that ends in .tbl or .json, or --format [tools.format]");
  }
  if (is_table && arguments.units.empty()) {
    return fail(exit_bad_program,
                "--units: expected mm or inch, as LINEAR_UNITS in the machine's ini file, because a tool table of "
                "LinuxCNC does not state its units [tools.no-units]");
  }
  const std::string text =
      is_table ? linuxcnc_tool_table(library->tools(), units_of(arguments.units)) : tool_library_json(library->tools());
  const int code = write_new_file(arguments.output, text, arguments.force);
  if (code == exit_done && is_table) {
    note(fmt::format("{} has no lengths: measure them, or copy Z from the old table", arguments.output));
  }
  return code;
}

}  // namespace passo
