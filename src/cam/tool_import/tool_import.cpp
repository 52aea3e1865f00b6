#include "passo/tool_import/tool_import.hpp"

#include <algorithm>
#include <utility>

#include "format_readers.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/surface_file/zip_member.hpp"

namespace passo {
namespace {

constexpr std::string_view expected_formats =
    "a .tools or .json file of Fusion, a .fctb or .fctl file of FreeCAD, a tool table of LinuxCNC, or our own JSON";

void refuse(std::string code, const std::string& file, std::string message, std::string expected,
            Diagnostics& diagnostics) {
  diagnostics.add(of_file(std::move(code), file, std::move(message), std::move(expected)));
}

std::optional<ImportedTools> import_json(std::string_view text, const std::string& file,
                                         const ToolImportOptions& options, Diagnostics& diagnostics) {
  auto source = JsonSource::parse(text, file, diagnostics);
  if (!source) return std::nullopt;
  const auto& root = source->root();
  const auto has = [&](const char* key) { return JsonSource::find(root, key) != nullptr; };
  const auto* const format = JsonSource::find(root, "format");
  ImportedTools imported;
  if (format != nullptr && *format == "passo-tool-library") {
    const auto* const version = JsonSource::find(root, "version");
    if (version == nullptr || *version != 1) {
      refuse("tool-import.version", file, "this version of our JSON is not known", "version 1", diagnostics);
      return std::nullopt;
    }
    ToolCollector tools(ToolFileFormat::passo);
    read_passo_tools(*source, tools);
    imported = tools.take();
  } else if (has("data")) {
    ToolCollector tools(ToolFileFormat::fusion);
    read_fusion_tools(*source, tools);
    imported = tools.take();
  } else if (has("tools") || (has("shape") && has("parameter"))) {
    ToolCollector tools(ToolFileFormat::freecad);
    read_freecad_tools(*source, options, tools);
    imported = tools.take();
  } else {
    refuse("tool-import.format", file, "this JSON is not a tool library", std::string(expected_formats), diagnostics);
    return std::nullopt;
  }
  for (UnusedField& field : source->unused()) {
    if (imported.unused.size() < ImportedTools::most_fields) imported.unused.push_back(std::move(field));
  }
  return imported;
}

std::optional<ImportedTools> import_zip(std::string_view bytes, const std::string& file,
                                        const ToolImportOptions& options, Diagnostics& diagnostics) {
  const auto text = read_zip_member(bytes, "tools.json", JsonSource::largest);
  if (text) return import_json(*text, file, options, diagnostics);
  refuse("tool-import.zip", file, fmt::format("tools.json cannot be read from this zip archive: {}", text.error()),
         "a .tools file of Fusion", diagnostics);
  return std::nullopt;
}

}  // namespace

std::string_view name_of(ToolFileFormat format) {
  constexpr std::string_view names[] = {"fusion", "freecad", "linuxcnc", "passo"};
  return names[static_cast<std::size_t>(format)];
}

std::optional<ImportedTools> import_tools(std::string_view bytes, const std::string& file,
                                          const ToolImportOptions& options, Diagnostics& diagnostics) {
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.empty()) {
    refuse("tool-import.empty", file, "the file is empty", std::string(expected_formats), diagnostics);
    return std::nullopt;
  }
  if (bytes.starts_with("PK\x03\x04")) return import_zip(bytes, file, options, diagnostics);
  if (text.front() == '{' || text.front() == '[') return import_json(bytes, file, options, diagnostics);
  if (bytes.starts_with("SQLite format 3")) {
    refuse("tool-import.database", file,
           "this is an SQLite database, e.g. .vtdb of Vectric, whose tables are not public",
           std::string(expected_formats), diagnostics);
    return std::nullopt;
  }
  if (std::ranges::find(bytes, '\0') != bytes.end()) {
    refuse("tool-import.format", file, "this is a binary file of an unknown format, e.g. .tool of Vectric",
           std::string(expected_formats), diagnostics);
    return std::nullopt;
  }
  ToolCollector tools(ToolFileFormat::linuxcnc);
  std::vector<UnusedField> unused;
  if (!read_linuxcnc_tools(bytes, file, options, tools, unused, diagnostics)) return std::nullopt;
  ImportedTools imported = tools.take();
  imported.unused = std::move(unused);
  return imported;
}

}  // namespace passo
