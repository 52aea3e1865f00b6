#include <utility>

#include "source_readers.hpp"
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace passo {
namespace {

// Aliases of YAML can make a few lines a tree of any size, or one that contains itself: nodes and depth are limited.
class YamlTree {
 public:
  bool add(const YAML::Node& node, SourceNode& into, std::size_t depth) {
    if (++nodes_ > most_source_nodes || depth > deepest_source_node) return false;
    const YAML::Mark mark = node.Mark();
    if (!mark.is_null()) {
      into.line = static_cast<std::uint32_t>(mark.line + 1);
      into.column = static_cast<std::uint32_t>(mark.column + 1);
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
  std::size_t nodes_ = 0;
};

}  // namespace

std::optional<SourceNode> read_yaml_tree(const ImportSource& source, Diagnostics& diagnostics) {
  try {
    SourceNode root;
    if (YamlTree().add(YAML::Load(std::string(source.text)), root, 0)) return root;
    add_source_error(source, diagnostics, "import.too-large", 0, 0,
                     fmt::format("the file has more than {} values, or they are nested more than {} deep",
                                 most_source_nodes, deepest_source_node),
                     "FluidNC's configuration, usually some hundred lines");
  } catch (const YAML::Exception& error) {
    const bool has_place = !error.mark.is_null();
    add_source_error(source, diagnostics, "import.syntax",
                     has_place ? static_cast<std::uint32_t>(error.mark.line + 1) : 0,
                     has_place ? static_cast<std::uint32_t>(error.mark.column + 1) : 0,
                     fmt::format("this is not YAML: {}", error.msg), "FluidNC's configuration, with a blank after the colon of each key");
  }
  return std::nullopt;
}

}  // namespace passo
