#include "passo/controller_file/controller_file.hpp"

#include <utility>

#include "source_readers.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

const char* const expected_formats =
    "the answer of Grbl, grblHAL or FluidNC to $$, FluidNC's YAML, LinuxCNC's ini or a profile of Mach3 (XML)";

std::string line_of(std::string_view text, std::uint32_t line) {
  for (; line > 1; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return std::string(text.substr(0, std::size_t{1} << 16));
}

// The writer and the reader of machine files must agree: what is refused here is a mistake of the program, not of the
// user.
bool can_be_read(const ImportedMachine& machine, const std::string& file, Diagnostics& diagnostics) {
  Diagnostics found;
  if (parse_machine(machine.toml, file, found, MachineUse::any_board)) return true;
  for (const Diagnostic& finding : found.all()) {
    diagnostics.add(of_file("import.bad-result", file,
                            fmt::format("the machine file would be wrong: {}", std::string(finding.message)),
                            std::string(finding.expected)));
  }
  return false;
}

}  // namespace

void add_source_error(const ImportSource& source, Diagnostics& diagnostics, const char* code, std::uint32_t line,
                      std::uint32_t column, std::string message, std::string expected) {
  Diagnostic finding = of_file(code, source.file, std::move(message), std::move(expected));
  if (line > 0) {
    finding.place = {.line = line, .column = column, .length = 1};
    finding.text = line_of(source.text, line);
    if (column > finding.text.size() + 1) finding.text.clear();
  }
  diagnostics.add(std::move(finding));
}

std::optional<SourceNode> read_source_tree(ImportFormat format, const ImportSource& source, Diagnostics& diagnostics) {
  if (source.text.size() > most_source_bytes) {
    add_source_error(source, diagnostics, "import.too-large", 0, 0,
                     fmt::format("the file has more than {} bytes", most_source_bytes), expected_formats);
    return std::nullopt;
  }
  switch (format) {
    case ImportFormat::settings: return parse_settings_dump(source, diagnostics);
    case ImportFormat::fluidnc: return read_yaml_tree(source, diagnostics);
    case ImportFormat::linuxcnc: return parse_ini(source, diagnostics);
    case ImportFormat::mach3: return read_xml_tree(source, diagnostics);
  }
  return std::nullopt;
}

std::optional<ImportedMachine> import_controller_text(const ImportSource& source, std::optional<ImportFormat> format,
                                                      Diagnostics& diagnostics) {
  if (!format) format = detect_import_format(source.text);
  if (!format) {
    add_source_error(source, diagnostics, "import.unknown-format", 0, 0,
                     "the content of this file is none of the known formats", expected_formats);
    return std::nullopt;
  }
  const auto tree = read_source_tree(*format, source, diagnostics);
  if (!tree) return std::nullopt;
  auto machine = import_machine(*format, *tree, source, diagnostics);
  if (!machine || !can_be_read(*machine, source.file, diagnostics)) return std::nullopt;
  return machine;
}

std::optional<ImportedMachine> import_controller_file(const std::string& path, std::optional<ImportFormat> format,
                                                      Diagnostics& diagnostics) {
  const auto text =
      read_bytes(path, {.area = "import", .expected = expected_formats, .most = most_source_bytes}, diagnostics);
  if (!text) return std::nullopt;
  return import_controller_text({.file = path, .text = *text}, format, diagnostics);
}

}  // namespace passo
