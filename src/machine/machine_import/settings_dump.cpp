// The answer of Grbl, grblHAL or FluidNC to $$, as a terminal or a sender saved it, with other answers around it.
#include <algorithm>

#include "source_text.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// The number of a setting, "110", at the start of a line "$110=500.000 (x max rate, mm/min)"; empty: another line.
std::string_view setting_number(std::string_view line) {
  if (!line.starts_with('$')) return {};
  const std::size_t end = std::min(line.find_first_not_of("0123456789", 1), line.size());
  if (end == 1 || end > 5 || !without_blanks(line.substr(end)).starts_with('=')) return {};
  return line.substr(1, end - 1);
}

// The value, without the meaning in parentheses that older versions add.
std::string_view setting_value(std::string_view line) {
  std::string_view value = without_blanks(line.substr(line.find('=') + 1));
  return without_blanks(value.substr(0, std::min(value.find_first_of(" \t("), value.size())));
}

// "[VER:1.1f.20170801:]", "[FIRMWARE:grblHAL]": what the controller says of itself.
bool is_identity(std::string_view line) {
  return line.starts_with("[VER:") || line.starts_with("[FIRMWARE:") || line.starts_with("[AXS:") ||
         line.starts_with("[OPT:") || line.starts_with("[SIGNALS:") || line.starts_with("[KINEMATICS:");
}

}  // namespace

std::optional<SourceNode> parse_settings_dump(const ImportSource& source, Diagnostics& diagnostics) {
  if (!is_source_text(source, diagnostics)) return std::nullopt;
  SourceNode root;
  SourceLines lines(source.text);
  std::string_view line;
  while (lines.next(line)) {
    // A terminal puts a prompt before the line: "< $0=10".
    std::string_view trimmed = without_blanks(line);
    while (!trimmed.empty() && (trimmed.front() == '<' || trimmed.front() == '>'))
      trimmed = without_blanks(trimmed.substr(1));
    const std::string_view number = setting_number(trimmed);
    if (number.empty() && !is_identity(trimmed)) continue;
    SourceNode node;
    node.line = lines.number();
    std::string_view value = number.empty() ? trimmed.substr(trimmed.find(':') + 1) : setting_value(trimmed);
    if (number.empty() && value.ends_with(']')) value.remove_suffix(1);
    node.name = number.empty() ? std::string(trimmed.substr(1, trimmed.find(':') - 1)) : fmt::format("${}", number);
    node.text = value;
    node.column = value.empty() ? lines.column_of(trimmed) : lines.column_of(value);
    if (root.children.size() >= most_source_nodes) {
      add_import_error(source, diagnostics, "import.too-large", {.line = node.line, .column = 1, .length = 1},
                       fmt::format("the file has more than {} settings", most_source_nodes), "one answer to $$", line);
      return std::nullopt;
    }
    root.children.push_back(std::move(node));
  }
  if (std::ranges::none_of(root.children, [](const SourceNode& node) { return node.name.starts_with('$'); })) {
    add_import_error(source, diagnostics, "import.no-settings", {}, "there is no setting in this file",
                     "the answer of the controller to $$: lines like $100=250.000");
    return std::nullopt;
  }
  return root;
}

}  // namespace passo
