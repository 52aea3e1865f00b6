// Ini files as LinuxCNC reads them: sections, keys, and comments on lines of their own.
#include "source_text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_sections = 1000;

class IniReader {
 public:
  IniReader(const ImportSource& source, Diagnostics& diagnostics)
      : source_(source), diagnostics_(diagnostics), lines_(source.text) {}

  std::optional<SourceNode> read() {
    std::string_view line;
    while (lines_.next(line)) {
      if (!add(line)) return std::nullopt;
    }
    return std::move(root_);
  }

 private:
  bool add(std::string_view line);
  bool open_section(std::string_view line, std::string_view trimmed);
  bool add_key(std::string_view line, std::string_view trimmed);
  bool refuse(std::string_view line, std::string_view part, std::string message, std::string expected);
  bool count() { return ++nodes_ <= most_source_nodes; }

  const ImportSource& source_;
  Diagnostics& diagnostics_;
  SourceLines lines_;
  SourceNode root_;
  std::size_t section_ = 0;  // of the root's children
  std::size_t nodes_ = 0;
  bool continues_ = false;  // the line before ended with a backslash
};

bool IniReader::refuse(std::string_view line, std::string_view part, std::string message, std::string expected) {
  add_import_error(source_, diagnostics_, "import.syntax",
                   {.line = lines_.number(), .column = lines_.column_of(part), .length = 1}, std::move(message),
                   std::move(expected), line);
  return false;
}

bool IniReader::add(std::string_view line) {
  const std::string_view trimmed = without_blanks(line);
  if (continues_) {
    continues_ = trimmed.ends_with('\\');
    return true;
  }
  if (trimmed.starts_with("#INCLUDE")) {
    if (!count()) return refuse(line, trimmed, "too many keys", "a shorter file");
    root_.children.push_back({.name = "#INCLUDE",
                              .text = std::string(without_blanks(trimmed.substr(8))),
                              .children = {},
                              .line = lines_.number(),
                              .column = lines_.column_of(trimmed)});
    return true;
  }
  if (trimmed.empty() || trimmed.front() == '#' || trimmed.front() == ';') return true;
  return trimmed.front() == '[' ? open_section(line, trimmed) : add_key(line, trimmed);
}

bool IniReader::open_section(std::string_view line, std::string_view trimmed) {
  const std::size_t end = trimmed.find(']');
  if (end == std::string_view::npos) return refuse(line, trimmed, "a section without a closing bracket", "[SECTION]");
  const std::string_view name = without_blanks(trimmed.substr(1, end - 1));
  const auto found = std::ranges::find(root_.children, name, &SourceNode::name);
  section_ = static_cast<std::size_t>(found - root_.children.begin());
  if (found != root_.children.end()) return true;
  if (!count() || root_.children.size() >= most_sections) {
    return refuse(line, trimmed, "too many sections", "a shorter file");
  }
  root_.children.push_back({.name = std::string(name),
                            .text = {},
                            .children = {},
                            .line = lines_.number(),
                            .column = lines_.column_of(trimmed)});
  return true;
}

bool IniReader::add_key(std::string_view line, std::string_view trimmed) {
  const std::size_t equals = trimmed.find('=');
  const std::string_view name = without_blanks(trimmed.substr(0, equals));
  continues_ = trimmed.ends_with('\\');
  // LinuxCNC ignores a line that is no assignment.
  if (equals == std::string_view::npos || name.empty() || section_ >= root_.children.size()) return true;
  if (!count()) return refuse(line, trimmed, "too many keys", "a shorter file");
  const std::string_view value = without_blanks(trimmed.substr(equals + 1));
  root_.children[section_].children.push_back({.name = std::string(name),
                                               .text = std::string(value),
                                               .children = {},
                                               .line = lines_.number(),
                                               .column = lines_.column_of(value.empty() ? trimmed : value)});
  return true;
}

}  // namespace

std::optional<SourceNode> parse_ini(const ImportSource& source, Diagnostics& diagnostics) {
  if (!is_source_text(source, diagnostics)) return std::nullopt;
  return IniReader(source, diagnostics).read();
}

}  // namespace passo
