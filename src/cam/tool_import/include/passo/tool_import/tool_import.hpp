// import_tools: the tools of another program's library, for a library of our own (tool_library.hpp).
//
//   Fusion    .tools (a zip archive with tools.json), and its JSON export
//   FreeCAD   .fctb, a tool bit, and .fctl, a library that names tool bits
//   LinuxCNC  a tool table
//   Passo     the JSON of tool_library_json()
//
// The format follows from the content. Nothing is guessed: a tool is imported only if its shape, units and sizes are in
// the file, or are given in the options. Each imported tool is valid, because ToolLibrary reads it. What was not
// understood is listed, with its place in the file: a JSON pointer (RFC 6901), or a tool number.
//
// The formats are not documented by their makers. Sources: the post processors of Fusion (taper angle: one side; point
// angle: both), FreeCAD's CAM workbench (Mod/CAM/Path/Tool), LinuxCNC's "Tool table format".
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/tooling/cutting_tool.hpp"

namespace passo {

enum class ToolFileFormat : std::uint8_t { fusion, freecad, linuxcnc, passo };
std::string_view name_of(ToolFileFormat format);

struct ToolImportOptions {
  std::optional<LengthUnits> units = {};   // of a file that does not state them
  std::optional<CuttingShape> shape = {};  // of the tools of a file without shapes
  // Reads a tool bit that a library names, by its file name. Empty: there is none.
  std::function<std::optional<std::string>(const std::string& name)> read_tool_bit = {};
};

// A field of the file that the import does not use.
struct UnusedField {
  std::string field;      // "/data/*/geometry/HAND"
  std::size_t count = 0;  // how many tools have it
  std::string first;      // where it is first: "/data/0/geometry/HAND"
};
// A tool, or a part of it, and what happened to it.
struct ToolImportNote {
  std::string place;  // "/data/3", "T3"
  std::string text;   // a sentence without a full stop
};

struct ImportedTools {
  static constexpr std::size_t most_tools = 10'000;
  static constexpr std::size_t most_fields = 1000;

  ToolFileFormat format = ToolFileFormat::passo;
  std::vector<CuttingTool> tools = {};        // in ascending order of their numbers
  std::vector<ToolImportNote> changed = {};   // imported, but not exactly as in the file
  std::vector<ToolImportNote> left_out = {};  // not imported
  std::vector<UnusedField> unused = {};
};

// Returns nothing, and adds a diagnostic "tool-import.…", if the file is none of these formats or is damaged.
std::optional<ImportedTools> import_tools(std::string_view bytes, const std::string& file,
                                          const ToolImportOptions& options, Diagnostics& diagnostics);

// The tools as JSON, version 1 of our own format (docs/manual/tools.md). `file`: its name, for the member "file";
// empty: without.
std::string tool_library_json(std::span<const CuttingTool> tools, std::string_view file = {});
// A tool table for LinuxCNC: number, pocket (the same), diameter, description.
std::string linuxcnc_tool_table(std::span<const CuttingTool> tools, LengthUnits units);

}  // namespace passo
