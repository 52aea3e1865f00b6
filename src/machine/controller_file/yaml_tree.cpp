#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "source_readers.hpp"
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace passo {
namespace {

// FluidNC's own reader needs no blank after the colon of a key, and people write pulloff_mm:1.000. YAML needs one.
class FluidNcText {
 public:
  explicit FluidNcText(std::string_view text) {
    text_.reserve(text.size() + 64);
    for (std::uint32_t line = 1; !text.empty(); ++line) {
      const std::string_view all = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(text.size(), all.size() + 1));
      const std::size_t colon = colon_without_blank(all);
      if (colon > 0) longer_lines_.emplace(line, static_cast<std::uint32_t>(colon + 1));
      text_ += all.substr(0, colon);
      text_ += colon > 0 ? ": " : "";
      text_ += all.substr(colon > 0 ? colon + 1 : 0);
      text_ += '\n';
    }
  }
  const std::string& text() const { return text_; }
  // The column in the file of a column of text(), both from 1.
  std::uint32_t column_in_file(std::uint32_t line, std::uint32_t column) const {
    const auto longer = longer_lines_.find(line);
    return longer != longer_lines_.end() && column > longer->second ? column - 1 : column;
  }

 private:
  // Where a line "  key:value" has its colon; 0: it is another line.
  static std::size_t colon_without_blank(std::string_view line) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string_view::npos) return 0;
    const std::size_t colon =
        line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", first);
    if (colon == std::string_view::npos || colon == first || line[colon] != ':' || colon + 1 == line.size()) return 0;
    return line[colon + 1] == ' ' || line[colon + 1] == '\t' || line[colon + 1] == '\r' ? 0 : colon;
  }

  std::string text_;
  std::map<std::uint32_t, std::uint32_t> longer_lines_;  // the column of the colon
};

// Aliases of YAML can make a few lines a tree of any size, or one that contains itself: nodes and depth are limited.
class YamlTree {
 public:
  explicit YamlTree(const FluidNcText& text) : text_(text) {}

  bool add(const YAML::Node& node, SourceNode& into, std::size_t depth) {
    if (++nodes_ > most_source_nodes || depth > deepest_source_node) return false;
    const YAML::Mark mark = node.Mark();
    if (!mark.is_null()) {
      into.line = static_cast<std::uint32_t>(mark.line + 1);
      into.column = text_.column_in_file(into.line, static_cast<std::uint32_t>(mark.column + 1));
    }
    if (node.IsScalar()) into.text = node.Scalar().substr(0, longest_text);
    if (node.IsSequence()) {
      for (const YAML::Node& element : node) {
        if (!add(element, into.children.emplace_back(), depth + 1)) return false;
      }
    }
    if (node.IsMap()) {
      for (const auto& entry : node) {
        const YAML::Node& key = entry.first;
        SourceNode& child = into.children.emplace_back();
        if (key.IsScalar()) child.name = key.Scalar().substr(0, longest_text);
        if (!add(entry.second, child, depth + 1)) return false;
        if (child.line == 0 && !key.Mark().is_null()) child.line = static_cast<std::uint32_t>(key.Mark().line + 1);
      }
    }
    return true;
  }

 private:
  static constexpr std::size_t longest_text = 4096;
  const FluidNcText& text_;
  std::size_t nodes_ = 0;
};

}  // namespace

std::optional<SourceNode> read_yaml_tree(const ImportSource& source, Diagnostics& diagnostics) {
  const FluidNcText text(source.text);
  try {
    SourceNode root;
    if (YamlTree(text).add(YAML::Load(text.text()), root, 0)) return root;
    add_source_error(source, diagnostics, "import.too-large", 0, 0,
                     fmt::format("the file has more than {} values, or they are nested more than {} deep",
                                 most_source_nodes, deepest_source_node),
                     "FluidNC's configuration, usually some hundred lines");
  } catch (const YAML::Exception& error) {
    const bool has_place = !error.mark.is_null();
    const std::uint32_t line = has_place ? static_cast<std::uint32_t>(error.mark.line + 1) : 0;
    const std::uint32_t column = has_place ? static_cast<std::uint32_t>(error.mark.column + 1) : 0;
    add_source_error(source, diagnostics, "import.syntax", line, text.column_in_file(line, column),
                     fmt::format("this is not YAML: {}", error.msg), "FluidNC's configuration");
  }
  return std::nullopt;
}

}  // namespace passo
