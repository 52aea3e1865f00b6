#include "browser_import.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "request_values.hpp"

#include "passo/machine_import/machine_import.hpp"

namespace passo {
namespace {

std::uint32_t place_in(const CheckJson& node, const char* key) {
  const auto found = node.find(key);
  return found != node.end() && found->is_number_unsigned() && *found <= std::uint32_t{1} << 24U
             ? found->get<std::uint32_t>()
             : 0;
}

// False: there are too many nodes, or they are too deep.
bool read_tree(const CheckJson& json, SourceNode& node, std::size_t depth, std::size_t& nodes) {
  if (++nodes > most_source_nodes || depth > deepest_source_node) return false;
  if (!json.is_object()) return true;
  node.name = value_of<std::string>(json, "name", "");
  node.text = value_of<std::string>(json, "text", "");
  node.line = place_in(json, "line");
  node.column = place_in(json, "column");
  const auto children = json.find("children");
  if (children == json.end() || !children->is_array()) return true;
  return std::ranges::all_of(*children, [&](const CheckJson& child) {
    return read_tree(child, node.children.emplace_back(), depth + 1, nodes);
  });
}

std::optional<SourceNode> tree_of(const CheckJson& request, ImportFormat format, const ImportSource& source,
                                  Diagnostics& findings) {
  if (format == ImportFormat::settings) return parse_settings_dump(source, findings);
  if (format == ImportFormat::linuxcnc) return parse_ini(source, findings);
  SourceNode root;
  std::size_t nodes = 0;
  if (read_tree(request["tree"], root, 0, nodes)) return root;
  findings.add({.code = "import.too-large",
                .file = source.file,
                .place = {},
                .message = "the file has too many values, or they are nested too deep",
                .expected = "the configuration of a controller",
                .text = {}});
  return std::nullopt;
}

CheckJson lines_json(const ImportedMachine& machine) {
  CheckJson assumed = CheckJson::array();
  for (const AssumedValue& one : machine.assumed) assumed.push_back({{"target", one.target}, {"reason", one.reason}});
  CheckJson unmapped = CheckJson::array();
  for (const UnmappedValue& one : machine.unmapped) {
    unmapped.push_back({{"source", one.source}, {"value", one.value}, {"reason", one.reason}, {"line", one.line}});
  }
  return {{"controller", machine.controller},        {"toml", machine.toml},
          {"understood", machine.understood.size()}, {"assumed", std::move(assumed)},
          {"unmapped", std::move(unmapped)},         {"warnings", machine.warnings}};
}

}  // namespace

std::string import_in_browser(const std::string& request_text) {
  const CheckJson parsed = CheckJson::parse(request_text, nullptr, false);
  const CheckJson request = parsed.is_object() ? parsed : CheckJson::object();
  const auto text = value_of<std::string>(request, "text", "");
  const ImportSource source{.file = value_of<std::string>(request, "file", ""), .text = text};
  const auto named = value_of<std::string>(request, "format", "");
  const std::optional<ImportFormat> format = named.empty() ? detect_import_format(text) : import_format_of(named);
  CheckJson answer = {{"good", false}, {"format", nullptr}, {"findings", CheckJson::array()}};
  if (!format) return written(answer);
  answer["format"] = name_of(*format);
  const bool wants_tree = *format == ImportFormat::fluidnc || *format == ImportFormat::mach3;
  if (wants_tree && !request.contains("tree")) return written(answer);
  Diagnostics findings;
  const std::optional<SourceNode> tree = tree_of(request, *format, source, findings);
  const std::optional<ImportedMachine> machine =
      tree ? import_machine(*format, *tree, source, findings) : std::optional<ImportedMachine>();
  answer["good"] = machine.has_value();
  answer["findings"] = findings_with_sentences(findings);
  if (machine) answer.update(lines_json(*machine));
  return written(answer);
}

}  // namespace passo
